"""What is switched off at the door: refused with its payload, silent, and whole again when it is on."""

from __future__ import annotations

from bridge.msgs import Msg
from robotside.door.switched_off import SwitchedOff


def test_what_is_off_is_refused_with_its_payload_and_what_is_on_is_not() -> None:
    off = SwitchedOff()
    assert off.refusal("/arm/move") is None
    off.set("arm", ["/arm", "/arm/move"], on=False)
    refusal = off.refusal("/arm/move")
    assert refusal is not None
    assert str(refusal) == "/arm/move is not there: arm is switched off."
    assert refusal.args[0].code == "payload_off"
    assert refusal.args[0].parameters == {"payload": "arm"}
    assert off.refusal("/lights") is None
    off.set("arm", ["/arm", "/arm/move"], on=True)
    assert off.refusal("/arm/move") is None


def test_who_listens_hears_nothing_meanwhile_and_goes_on_afterwards() -> None:
    off, heard = SwitchedOff(), list[str]()
    listener = off.muted(lambda topic, _: heard.append(topic))
    for on in (True, False, True):
        off.set("arm", ["/arm"], on=on)
        listener("/arm", Msg())
        listener("/lights", Msg())
    assert heard == ["/arm", "/lights", "/lights", "/arm", "/lights"]
