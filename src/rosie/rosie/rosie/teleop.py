"""Drive Rosie with the arrow keys of a terminal."""

import os
from select import select
import sys
import termios
import tty

from geometry_msgs.msg import Twist
import rclpy

HELP = """Drive Rosie:  up and down: ahead and back   left and right: turn
              space: stop   q: quit
"""
#: Meters a second ahead, and radians a second to the left.
KEYS = {
    '\x1b[A': (0.4, 0.0),
    '\x1b[B': (-0.4, 0.0),
    '\x1b[D': (0.0, 1.2),
    '\x1b[C': (0.0, -1.2),
    ' ': (0.0, 0.0),
}
NO_KEYBOARD = """There are no keys to read here.
What it means: Its input is not a terminal that a person types in.
What to try:   In JupyterLab choose File, New, Terminal, and type the command there. Without keys:
               ros2 topic pub --once /rosie/cmd_vel geometry_msgs/msg/Twist "{linear: {x: 0.4}}"
"""


def pressed(seconds):
    """Return the key that is pressed within so many seconds; an empty text if none is."""
    if not select([sys.stdin], [], [], seconds)[0]:
        return ''
    # An arrow key sends three characters at once.
    return os.read(sys.stdin.fileno(), 3).decode(errors='ignore')


def drive(node):
    """Publish a command for each key until somebody quits."""
    publisher = node.create_publisher(Twist, 'cmd_vel', 10)
    while rclpy.ok():
        key = pressed(0.1)
        if key in ('q', '\x03', '\x04'):
            return
        if key in KEYS:
            command = Twist()
            command.linear.x, command.angular.z = KEYS[key]
            publisher.publish(command)


def main(args=None):
    """Read keys until `q` is pressed, and leave the terminal as it was."""
    if not sys.stdin.isatty():
        sys.exit(NO_KEYBOARD)
    print(HELP, flush=True)
    settings = termios.tcgetattr(sys.stdin)
    rclpy.init(args=args)
    try:
        tty.setcbreak(sys.stdin)
        drive(rclpy.create_node('teleop', namespace='rosie'))
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)


if __name__ == '__main__':
    main()
