"""The catalogue of a station: all services and actions that it has for its clients."""

from __future__ import annotations

from collections.abc import Iterable

from bridge.core.robot_catalogue import Action, Service
from robotside.services.command_service import CommandService
from robotside.services.control_services import control_services
from robotside.services.equipment_services import equipment_services
from robotside.services.mission_services import mission_services
from robotside.services.records_services import records_services
from robotside.services.stop_services import stop_services
from robotside.services.task_actions import task_actions
from robotside.services.task_services import task_services
from robotside.station.station import Station

__all__ = ["catalogue"]


def catalogue(
    station: Station, answering: CommandService | None = None
) -> tuple[dict[str, Service], dict[str, Action]]:
    """The services and the actions of `station` by name; `answering` runs them, by default one of their own."""
    answering = answering or CommandService(station)
    services: list[Service] = []
    for family in (
        stop_services,
        task_services,
        mission_services,
        records_services,
        control_services,
        equipment_services,
    ):
        services.extend(family(station, answering))
    actions: Iterable[Action] = task_actions(station, answering)
    return {each.name: each for each in services}, {each.name: each for each in actions}
