"""The screens of one robot in their frame, made when there is a robot to show."""

from __future__ import annotations

from typing import Any

from app.layout import Layout
from app.screens.drive import DriveScreen
from app.screens.mission import MissionScreen
from app.screens.shell import Shell
from app.screens.tasks import TasksScreen
from app.screens.topics import TopicsScreen
from app.session import Session

__all__ = ["robot_shell"]


def robot_shell(app: Any, session: Session, layout: Layout, **kwargs: Any) -> Shell:
    """The frame with every screen in it; `layout` says which instruments the drive screen has."""
    screens = {
        "mission": MissionScreen(app=app, session=session),
        "drive": DriveScreen(layout, app=app, session=session),
        "tasks": TasksScreen(app=app, session=session),
        "topics": TopicsScreen(app=app, session=session),
    }
    return Shell(screens, app=app, session=session, **kwargs)
