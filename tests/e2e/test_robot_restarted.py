"""The robot side dies and comes back: the app finds it again, and what was entered is still there."""

from __future__ import annotations

import os
import resource
import signal
from pathlib import Path

from bridge.msgs.pilothouse_msgs import TaskOrder
from examples.demo.robot import RobotProcess
from tests.e2e.handheld import Handheld, handheld


def serve(folder: Path, port: int) -> RobotProcess:
    options = ("--robot", "sim:patrol", "--world", "parking_lot", "--state", str(folder / "state"))
    return RobotProcess(*options, "--port", str(port), log=folder / "robot.log")


def test_a_killed_and_restarted_robot_is_found_again_with_draft_mission_and_the_task_to_resume(
    tmp_path: Path,
) -> None:
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
            session.command("start", order=TaskOrder(task="hold", duration=600.0))
            glass.until(lambda: session.feeds.latest("/task/status").state == "RUNNING", "the task")
            task = session.feeds.latest("/task/status").task_id
            os.kill(robot.pid, signal.SIGKILL)
            glass.until(lambda: not session.connected, "the app to notice")
            assert len(session.mission.draft.points) == 3
            old = session.feeds.latest("/pose")
            robot.close()
            robot = serve(tmp_path, port)
            glass.until(lambda: session.connected, "the app to reconnect by itself", 10.0)
            glass.until(lambda: len(session.feeds.latest("/mission").waypoints) == 2, "the stored mission")
            glass.run(0.5)
            assert len(session.mission.draft.points) == 3, (
                "the point that was not sent yet is still on the glass"
            )
            cut = session.feeds.latest("/task/status")
            assert (cut.task_id, cut.state) == (task, "INTERRUPTED"), "nothing goes on by itself"
            glass.until(
                lambda: all(session.feeds.latest("/pose") is not one for one in (None, old)),
                "the robot to find where it is",
            )
            glass.tap("Resume")
            glass.until(lambda: session.feeds.latest("/task/status").state == "RUNNING", "it to go on")
            assert session.feeds.latest("/task/status").task_id == task
    finally:
        robot.close()


def test_a_damaged_database_and_a_disk_that_takes_nothing_are_said_on_the_glass(tmp_path: Path) -> None:
    (tmp_path / "state").mkdir()
    database = tmp_path / "state" / "records.sqlite3"
    database.write_bytes(b"no database" * 1000)
    with (
        serve(tmp_path, 0) as robot,
        handheld(tmp_path / "handheld", url=robot.url, screen="mission", discover=False) as glass,
    ):
        session = glass.until(lambda: glass.app.session if glass.app.shell else None, "the robot")
        glass.until(lambda: says(glass, "database", "set aside"), "what became of the database")
        glass.until(lambda: session.feeds.latest("/pose"), "a pose")
        glass.control()
        pose = session.feeds.latest("/pose").pose.pose.position
        session.mission.add(pose.x + 1.0, pose.y)
        # from now on its files cannot grow
        resource.prlimit(robot.pid, resource.RLIMIT_FSIZE, (1, resource.RLIM_INFINITY))
        session.send_mission()
        # of this mission, not of something else that the robot writes: while it is under way it is not sent again
        glass.until(lambda: says(glass, "Refused: send the mission", "nothing was stored"), "its refusal")
        glass.until(lambda: says(glass, "The disk", "nothing was stored"), "that nothing was stored")
        assert session.mission.dirty
        resource.prlimit(robot.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
        session.send_mission()
        glass.until(lambda: not session.mission.dirty, "the mission to be stored")


def says(glass: Handheld, *parts: str) -> bool:
    """Something that can be read holds all `parts`."""
    return any(all(part in words for part in parts) for words in glass.words())
