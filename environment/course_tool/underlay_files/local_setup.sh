# Made by the course rosbeat. Activates the ROS in this folder, as /opt/ros/jazzy/setup.sh does
# for an installed one: `source .venv/setup.bash`, or setup.sh in another shell.
#
# PYTHONPATH and LD_LIBRARY_PATH stay as they are: the Python of this folder knows its own packages
# and libraries, and any other Python must not see them.

_rosbeat_prepend() { # NAME VALUE: the value comes first in the list, unless it is there already
    eval "_rosbeat_list=\${$1-}"
    case ":$_rosbeat_list:" in
        *":$2:"*) ;;
        *) export "$1=$2${_rosbeat_list:+:$_rosbeat_list}" ;;
    esac
    unset _rosbeat_list
}
_rosbeat_prepend PATH @PREFIX@/bin
_rosbeat_prepend AMENT_PREFIX_PATH @PREFIX@
unset -f _rosbeat_prepend

# The rest (middleware, domain id, discovery) is decided in one place, which every Python uses too.
# Without it the commands still start, and set the same for themselves.
eval "$(@PYTHON@ -I -S @ENVIRONMENT@ @PREFIX@ 2>/dev/null)"
