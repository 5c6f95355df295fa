"""
Drive Rosie through her greenhouse.

| name | what it is |
|---|---|
| `cmd_vel` | topic, `geometry_msgs/msg/Twist`: how fast she is to drive ahead and to turn |
| `pose` | topic, `geometry_msgs/msg/Pose2D`: where she is, ten times a second |
| `scan` | topic, `sensor_msgs/msg/LaserScan`: how far the walls are, five times a second |
| `map` | topic, `nav_msgs/msg/OccupancyGrid`: the greenhouse, for everyone who joins |
| `lamp` | topic, `std_msgs/msg/Bool`: whether her lamp is on, for everyone who joins |
| `reset` | service, `std_srvs/srv/Empty`: back to the door |
| `step` | service, `std_srvs/srv/Trigger`: a quarter of a meter ahead, unless a wall is there |
| `set_lamp` | service, `std_srvs/srv/SetBool` |
| `visit_beds` | action, `test_msgs/action/Fibonacci`: visit so many beds, feel how warm they are |
| `speed_limit` | parameter: meters a second |
| `patience` | parameter: seconds for which she follows a command |

All names are below `/rosie`.
"""

import math

from geometry_msgs.msg import Pose2D, Twist
from nav_msgs.msg import OccupancyGrid
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool
from std_srvs.srv import Empty, SetBool, Trigger
from test_msgs.action import Fibonacci

from rosie import greenhouse

RADIUS = 0.17
TURN_LIMIT = 2.0
POSE_PERIOD, SCAN_PERIOD = 0.1, 0.2
RAYS, SHORTEST, LONGEST = 72, 0.05, 5.0
STEP = 0.25
CELL = 0.1
#: Those who join late get the last message.
LAST_ONE = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def bounded(value, limit):
    """Return a value between minus the limit and the limit; 0 for what is no number."""
    return max(-limit, min(limit, value)) if math.isfinite(value) else 0.0


def turn_between(theta, other):
    """Return the shorter turn from one direction to another, from -pi to pi."""
    return math.remainder(other - theta, math.tau)


class Tour:
    """Hold a goal of `visit_beds`: what is left of the way, and what was felt."""

    def __init__(self, goal, place):
        self.goal = goal
        self.stops = list(greenhouse.STOPS[:goal.request.order])
        self.corners = greenhouse.route(place, self.stops[0])
        self.readings = []
        self.finished = Future()


class Rover(Node):
    """Follow commands, report where it is, and keep out of the walls."""

    def __init__(self):
        super().__init__('rover', namespace='rosie')
        self.pose = greenhouse.START
        self.command, self.command_time = Twist(), None
        self.is_blocked = False
        self.tour = None
        self.declare_limits()

        self.pose_publisher = self.create_publisher(Pose2D, 'pose', 10)
        self.scan_publisher = self.create_publisher(LaserScan, 'scan', 10)
        self.map_publisher = self.create_publisher(OccupancyGrid, 'map', LAST_ONE)
        self.lamp_publisher = self.create_publisher(Bool, 'lamp', LAST_ONE)
        self.create_subscription(Twist, 'cmd_vel', self.follow, 10)
        self.create_service(Empty, 'reset', self.reset)
        self.create_service(Trigger, 'step', self.step)
        self.create_service(SetBool, 'set_lamp', self.set_lamp)
        self.action_server = ActionServer(
            self, Fibonacci, 'visit_beds', self.visit_beds,
            goal_callback=self.consider, cancel_callback=lambda _: CancelResponse.ACCEPT)

        self.moved_at = self.get_clock().now()
        self.create_timer(POSE_PERIOD, self.move)
        self.create_timer(SCAN_PERIOD, self.scan)
        self.publish_map()
        self.lamp_publisher.publish(Bool(data=False))
        self.get_logger().info('Rosie is at the door, and waits for /rosie/cmd_vel')

    def declare_limits(self):
        """Declare the parameters, with the values that they may have."""
        for name, value, low, high, description in (
            ('speed_limit', 0.5, 0.05, 1.0, 'Meters a second that she drives at most.'),
            ('patience', 1.0, 0.1, 60.0, 'Seconds for which she follows a command.'),
        ):
            bounds = FloatingPointRange(from_value=low, to_value=high)
            self.declare_parameter(name, value, ParameterDescriptor(
                description=description, floating_point_range=[bounds]))

    # Moving.

    def follow(self, command):
        """Take a command; whoever drives by hand ends a tour."""
        self.command, self.command_time = command, self.get_clock().now()
        if self.tour is not None:
            self.end_tour('Somebody drives by hand, so the tour ends')

    def move(self):
        """Move on by what the last command asks for, and tell where she is."""
        before, self.moved_at = self.moved_at, self.get_clock().now()
        seconds = (self.moved_at - before).nanoseconds / 1e9
        if seconds <= 0.0:
            return  # a simulated clock was set back
        if self.tour is not None:
            self.steer(seconds)
        else:
            self.advance(*self.wanted_speeds(), seconds)
        self.pose_publisher.publish(Pose2D(
            x=self.pose.x, y=self.pose.y, theta=self.pose.theta))

    def wanted_speeds(self):
        """Return the speeds ahead and around that the last command asks for, if it still holds."""
        patience = self.get_parameter('patience').value
        if self.command_time is None:
            return 0.0, 0.0
        if (self.moved_at - self.command_time).nanoseconds >= patience * 1e9:
            return 0.0, 0.0
        limit = self.get_parameter('speed_limit').value
        return (
            bounded(self.command.linear.x, limit), bounded(self.command.angular.z, TURN_LIMIT))

    def advance(self, speed, turn, seconds):
        """Drive along a circle, or straight ahead, unless something is in the way."""
        x, y, theta = self.pose
        # The middle of the turn is the direction of the chord.
        middle = theta + turn * seconds / 2.0
        half = turn * seconds / 2.0
        chord = speed * seconds * (math.sin(half) / half if abs(half) > 1e-9 else 1.0)
        new_x, new_y = x + chord * math.cos(middle), y + chord * math.sin(middle)
        is_free = greenhouse.is_free(new_x, new_y, RADIUS)
        if not is_free:
            new_x, new_y = x, y
            if not self.is_blocked:
                self.get_logger().warning(f'Bump! Something is in the way at ({x:.1f}, {y:.1f})')
        if speed:
            self.is_blocked = not is_free
        self.pose = greenhouse.Pose(
            new_x, new_y, math.remainder(theta + turn * seconds, math.tau))

    def scan(self):
        """Publish how far the walls are all around, counterclockwise from straight ahead."""
        step = math.tau / RAYS
        x, y, theta = self.pose
        scan = LaserScan(
            angle_min=0.0, angle_max=step * (RAYS - 1), angle_increment=step,
            scan_time=SCAN_PERIOD, range_min=SHORTEST, range_max=LONGEST,
            ranges=[
                round(greenhouse.range_to_wall(x, y, theta + ray * step, LONGEST), 3)
                for ray in range(RAYS)])
        scan.header.stamp = self.get_clock().now().to_msg()
        scan.header.frame_id = 'rosie'
        self.scan_publisher.publish(scan)

    def publish_map(self):
        """Publish the greenhouse once; it stays for those who join later."""
        cells, width, height = greenhouse.occupancy(CELL)
        grid = OccupancyGrid(data=cells)
        grid.header.stamp = self.get_clock().now().to_msg()
        grid.header.frame_id = 'map'
        grid.info.resolution, grid.info.width, grid.info.height = CELL, width, height
        grid.info.origin.orientation.w = 1.0
        self.map_publisher.publish(grid)

    # Services.

    def reset(self, request, response):
        """Put Rosie back to the door."""
        self.pose, self.command_time, self.is_blocked = greenhouse.START, None, False
        if self.tour is not None:
            self.end_tour('Rosie was put back to the door, so the tour ends')
        self.get_logger().info('Rosie is at the door again')
        return response

    def step(self, request, response):
        """Go a quarter of a meter ahead at once, or say why not."""
        x, y, theta = self.pose
        new_x, new_y = x + STEP * math.cos(theta), y + STEP * math.sin(theta)
        response.success = greenhouse.is_free(new_x, new_y, RADIUS)
        if response.success:
            self.pose = greenhouse.Pose(new_x, new_y, theta)
            response.message = f'now at ({new_x:.2f}, {new_y:.2f})'
        else:
            response.message = 'something is in the way'
        return response

    def set_lamp(self, request, response):
        """Turn the lamp on or off."""
        self.lamp_publisher.publish(Bool(data=request.data))
        response.success = True
        response.message = 'the lamp is ' + ('on' if request.data else 'off')
        return response

    # The action.

    def consider(self, request):
        """Accept a tour if there are so many beds to visit, and no other tour is on the way."""
        if self.tour is None and 1 <= request.order <= len(greenhouse.STOPS):
            return GoalResponse.ACCEPT
        self.get_logger().warning(
            f'A tour has 1 to {len(greenhouse.STOPS)} stops, and there is one tour at a time')
        return GoalResponse.REJECT

    async def visit_beds(self, goal):
        """Visit beds; the timer does the driving meanwhile."""
        tour = self.tour = Tour(goal, self.pose[:2])
        await tour.finished
        if goal.is_active:
            goal.abort()
        return Fibonacci.Result(sequence=tour.readings)

    def steer(self, seconds):
        """Drive on towards the next corner of a tour."""
        tour = self.tour
        if tour.goal.is_cancel_requested:
            tour.goal.canceled()
            self.end_tour('The tour is canceled')
            return
        corner = tour.corners[0]
        away = math.dist(self.pose[:2], corner)
        limit = self.get_parameter('speed_limit').value
        if away < 0.01:
            tour.corners.pop(0)
            if not tour.corners:
                self.arrive(tour)
            return
        ahead = math.atan2(corner[1] - self.pose.y, corner[0] - self.pose.x)
        turn = turn_between(self.pose.theta, ahead)
        if abs(turn) > 0.02:
            self.advance(0.0, bounded(turn / seconds, TURN_LIMIT), seconds)
        else:
            self.advance(min(limit, away / seconds), bounded(turn / seconds, TURN_LIMIT), seconds)

    def arrive(self, tour):
        """Feel how warm a bed is, and report it; set off for the next one, or finish."""
        tour.readings.append(round(greenhouse.temperature(*self.pose[:2])))
        tour.goal.publish_feedback(Fibonacci.Feedback(sequence=tour.readings))
        tour.stops.pop(0)
        if tour.stops:
            tour.corners = greenhouse.route(self.pose[:2], tour.stops[0])
            return
        tour.goal.succeed()
        self.end_tour(f'All beds are visited: {tour.readings}')

    def end_tour(self, why):
        """Let the action's callback return its result."""
        tour, self.tour = self.tour, None
        self.get_logger().info(why)
        tour.finished.set_result(None)


def main(args=None):
    """Run Rosie until somebody stops her."""
    rclpy.init(args=args)
    try:
        rclpy.spin(Rover())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
