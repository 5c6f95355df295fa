# Made by the course rosbeat: local_setup.sh, and completion of the commands.
. @PREFIX@/local_setup.sh
for _rosbeat_file in @COMPLETIONS@/ros2 @COMPLETIONS@/colcon; do
    [ ! -f "$_rosbeat_file" ] || . "$_rosbeat_file"
done
unset _rosbeat_file
