"""The robot side dies and comes back: the app finds it again, and what was entered is still there."""

from __future__ import annotations

import os
import signal
from pathlib import Path

from examples.demo.robot import RobotProcess
from tests.e2e.handheld import handheld


def serve(folder: Path, port: int) -> RobotProcess:
    options = ("--robot", "sim:patrol", "--world", "parking_lot", "--state", str(folder / "state"))
    return RobotProcess(*options, "--port", str(port), log=folder / "robot.log")


def test_a_killed_and_restarted_robot_is_found_again_with_draft_and_stored_mission(tmp_path: Path) -> None:
    robot = serve(tmp_path, 0)
    port = int(robot.url.rsplit(":", 1)[1])
    try:
        with handheld(tmp_path / "handheld", url=robot.url, discover=False) as glass:
            session = glass.until(lambda: glass.app.session if glass.app.shell else None, "the robot")
            glass.until(lambda: session.feeds.latest("/mission") is not None, "the mission")
            glass.until(lambda: session.feeds.latest("/pose") is not None, "a pose")
            pose = session.feeds.latest("/pose").pose.pose.position
            session.mission.add(pose.x + 1.0, pose.y)
            session.mission.add(pose.x + 2.0, pose.y)
            session.send_mission()
            glass.until(lambda: not session.mission.dirty, "the mission to be stored")
            session.mission.add(pose.x + 3.0, pose.y)
            os.kill(robot.pid, signal.SIGKILL)
            glass.until(lambda: not session.connected, "the app to notice")
            assert len(session.mission.draft.points) == 3
            robot.close()
            robot = serve(tmp_path, port)
            glass.until(lambda: session.connected, "the app to reconnect by itself", 10.0)
            glass.until(lambda: len(session.feeds.latest("/mission").waypoints) == 2, "the stored mission")
            glass.run(0.5)
            assert len(session.mission.draft.points) == 3, (
                "the point that was not sent yet is still on the glass"
            )
    finally:
        robot.close()
