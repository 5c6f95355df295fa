# Start file of `./environment/course shell`: the user's own first, then the course's environment.
[ -f ~/.bashrc ] && . ~/.bashrc
eval "$("$ROSBEAT_COURSE" variables)"
PS1="(rosbeat) ${PS1:-\\w\\$ }"
