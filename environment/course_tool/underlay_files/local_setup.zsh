# Made by ./environment/course: local_setup.sh, which zsh reads as well.
. @PREFIX@/local_setup.sh
