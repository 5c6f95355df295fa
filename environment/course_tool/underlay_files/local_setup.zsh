# Made by the course rosbeat: local_setup.sh, which zsh reads as well.
. @PREFIX@/local_setup.sh
