# Start file of `./environment/course shell` and of JupyterLab's terminals: the user's own first,
# which may put another Python or another ROS first; then the course's environment.
[ ! -f ~/.bashrc ] || . ~/.bashrc
eval "$("$ROSBEAT_COURSE" variables)"
. "$VIRTUAL_ENV/setup.bash"
# A shell that would start in the checkout starts where the workspace lies, if that is elsewhere.
if [ -n "${ROSBEAT_WORKSPACE_IN-}" ] && [ "$PWD" -ef "${ROSBEAT_COURSE%/environment/course}" ]; then
    cd -- "${ROSBEAT_WORKSPACE_IN/#\~/$HOME}" || :
fi
PS1="(rosbeat) ${PS1:-\\w\\$ }"
