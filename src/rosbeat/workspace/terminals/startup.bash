# Run by bash once, before its first prompt, in every terminal of a page. The prompt is a mark that
# nobody sees: it says that the command before has ended, with which code, and in which folder.
# Only this shell has such a prompt, not a bash that is started in it.
export -n PS0 PS1 PS2 PROMPT_COMMAND
unset HISTFILE INPUTRC MAILCHECK TMOUT
# `echo "Hello!"` is not a reference to an earlier command.
set +H
# What is typed is shown by the page, not by the terminal.
stty -echo 2>/dev/null
bind 'set enable-bracketed-paste off' 2>/dev/null
bind 'set disable-completion on'
bind 'set bell-style none'
bind 'set input-meta on'
bind 'set output-meta on'
bind 'set convert-meta off'
bind '"\t": self-insert'
__rosbeat_ps1='\[\e]7771;'$ROSBEAT_TERMINAL';P;$?;$PWD\a\]'
__rosbeat_ps2='\[\e]7771;'$ROSBEAT_TERMINAL';M;;\a\]'
# Printed when a command has been read and before it runs; bash 4.4 and later.
PS0='\e]7771;'$ROSBEAT_TERMINAL';R;;\a'
# A virtual environment's `activate` puts its name into PS1; here PS1 is put back. A command such as
# `stty sane` turns the echo on. `set -x` is not to show that.
PROMPT_COMMAND='{ PS1=$__rosbeat_ps1 PS2=$__rosbeat_ps2; stty -echo || :; } 2>/dev/null'
PS1=$__rosbeat_ps1 PS2=$__rosbeat_ps2
