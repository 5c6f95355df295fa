# Start file of `./environment/course shell` and of JupyterLab's terminals: the user's own first,
# which may put another Python or another ROS first; then the course's environment.
[ ! -f ~/.bashrc ] || . ~/.bashrc
eval "$("$ROSBEAT_COURSE" variables)"
. "$VIRTUAL_ENV/setup.bash"
# A shell that would start in the checkout starts in the learner's own folder, where the workspace
# lies: nothing of the course's own is there to be removed by mistake.
for _rosbeat_folder in "${ROSBEAT_COURSE%/environment/course}"{,/my_course}; do
    if [ "$PWD" -ef "$_rosbeat_folder" ]; then
        cd -- "${ROS2_WORKSPACE%/*}" || :
        break
    fi
done
unset _rosbeat_folder
PS1="(rosbeat) ${PS1:-\\w\\$ }"
