"""Everything on the glass made anew: words, sizes of type, figures and places are taken when a widget is made.

The session with the robot goes on, its link and its control too, and whatever was typed or drawn; every control lets go first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kivy.clock import Clock

from app.core.hand import hand
from app.screens.connect.connect import ConnectScreen

if TYPE_CHECKING:
    from app.screens.shell.shell import Shell  # made when there is a robot, for a quick start

__all__ = ["Renewal"]


class Renewal:
    """Asked for by any choice that changes how widgets are made; done once, with the next frame."""

    def __init__(self, app: Any) -> None:
        """`app` has the `pages`, the `visit`, and what makes their screens."""
        self._app = app
        self.ask = Clock.create_trigger(lambda _: self.do(), 0)
        """Have it done with the next frame: whoever asks may be a widget that goes."""

    def close(self) -> None:
        """Do nothing more."""
        self.ask.cancel()

    def do(self) -> None:
        """Make the page that is on the glass, and forget the others, which are made when they are looked at."""
        app = self._app
        app.inputs.rest()
        hand.take_up()
        kept = app.pages.forget_lone()
        self._renew_connect()
        app.corner.renew()
        if app.pages.shell is not None:
            self._renew_shell(app.pages.shell)
        elif kept is not None:
            name, state = kept
            app.pages.show_lone(name)
            if state is not None:
                app.pages.lone(name).screen.take_up(state)
        else:
            app.pages.show_connect()
        app.corner.tick()
        app.renew_tour()

    def _renew_connect(self) -> None:
        app, before = self._app, self._app.connect
        fresh = ConnectScreen(app=app, can_simulate=before.can_simulate)
        fresh.simulating, fresh.simulator_text = before.simulating, before.simulator_text
        app.connect = app.pages.connect = app.visit.connect = fresh
        app.robot_list.refresh()

    def _renew_shell(self, before: Shell) -> None:
        from app.screens.robot_screens import robot_shell

        app = self._app
        session, screen = before.session, before.screen
        kept = {name: made.keep() for name, made in before.screens.made.items()}
        before.close()
        app.collector.expect(before)
        fresh = robot_shell(
            app, session, app.profiles, before, size=app.pages.root.size, pos=app.pages.root.pos
        )
        app.pages.replace(fresh, screen)
        for name, state in kept.items():
            if state is not None:
                fresh.screens[name].take_up(state)
