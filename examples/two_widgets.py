"""A compass and a stick for a robot, without the app: `python -m examples.two_widgets`."""

from kivy.base import runTouchApp
from kivy.clock import Clock, mainthread
from kivy.uix.boxlayout import BoxLayout

from bridge.client import RemoteRobot
from widgets import Compass, Joystick


def two_widgets(robot: RemoteRobot) -> BoxLayout:
    """A compass that turns as `robot` does, and a stick that drives it for as long as it is held."""
    compass, stick = Compass(state="live"), Joystick(max_speed=0.5)
    robot.on("/imu/data", mainthread(compass.show))
    stick.bind(on_command=lambda _, twist: robot.publish("/cmd_vel", twist))

    def hold(_: float) -> None:
        if stick.forward or stick.left:
            robot.publish("/cmd_vel", stick.twist)

    Clock.schedule_interval(hold, 0.05)
    row = BoxLayout()
    row.add_widget(compass)
    row.add_widget(stick)
    return row


if __name__ == "__main__":
    with RemoteRobot("ws://127.0.0.1:9090") as robot:
        runTouchApp(two_widgets(robot))
