"""The robot of the recording: a node of ROS 2 whose values the suite knows; needs rclpy, so only the recorder runs it."""

from __future__ import annotations

import math

import rclpy  # type: ignore[import-not-found]
from geometry_msgs.msg import Twist  # type: ignore[import-not-found]
from nav_msgs.msg import Odometry  # type: ignore[import-not-found]
from rclpy.qos import DurabilityPolicy, QoSProfile  # type: ignore[import-not-found]
from sensor_msgs.msg import BatteryState, CompressedImage, Imu, LaserScan  # type: ignore[import-not-found]
from std_msgs.msg import String  # type: ignore[import-not-found]
from std_srvs.srv import SetBool, Trigger  # type: ignore[import-not-found]


def filled(node, message):
    """A message with something in every kind of field."""
    if hasattr(message, "header"):
        message.header.stamp = node.get_clock().now().to_msg()
        message.header.frame_id = "base_link"
    if isinstance(message, Odometry):
        message.child_frame_id = "base_footprint"
        message.pose.pose.position.x = 1.25
        message.pose.covariance[7] = 0.5
        message.twist.twist.angular.z = -0.125
    elif isinstance(message, LaserScan):
        message.angle_min, message.angle_increment = -1.0, 0.0625
        message.range_max = 8.0
        message.ranges = [math.nan, math.inf, *(0.5 + 0.125 * beam for beam in range(30))]
        message.intensities = [7.0] * 32
    elif isinstance(message, Imu):
        message.linear_acceleration.z = 9.75
        message.orientation_covariance[0] = -1.0
        message.angular_velocity.x = math.nan
    elif isinstance(message, BatteryState):
        message.voltage, message.current, message.percentage = 12.5, math.nan, 0.75
        message.temperature = math.inf
        message.cell_voltage = [4.0, 4.25]
        message.present = True
    elif isinstance(message, CompressedImage):
        message.format = "jpeg"
        message.data = bytes([255, 216]) + bytes(range(256))
    return message


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("demo_robot")
    topics = {
        "/odom": Odometry,
        "/scan": LaserScan,
        "/imu/data": Imu,
        "/battery_state": BatteryState,
        "/camera/image/compressed": CompressedImage,
    }
    for name, kind in topics.items():
        out = node.create_publisher(kind, name, 10)
        node.create_timer(0.1, lambda out=out, kind=kind: out.publish(filled(node, kind())))
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_publisher(String, "/robot_description", latched).publish(String(data="<robot name='disc'/>"))
    heard = node.create_publisher(Twist, "/cmd_vel_heard", 10)
    node.create_subscription(Twist, "/cmd_vel", heard.publish, 10)

    def beep(_, response):
        response.success, response.message = True, "beep"
        return response

    def motors(request, response):
        response.success, response.message = True, "motors on" if request.data else "motors off"
        return response

    node.create_service(Trigger, "/beep", beep)
    node.create_service(SetBool, "/enable_motors", motors)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
