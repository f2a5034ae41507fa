"""What a client does for others, without a network."""

from __future__ import annotations

import asyncio

import pytest

from bridge.client.service_provider import MAX_CALLS, ServiceProvider
from bridge.core.errors import ProtocolError
from bridge.msgs.std_srvs import TriggerRequest, TriggerResponse
from bridge.protocol import CallService, ClientSession
from tests.bridge.wires import Record


async def test_so_many_calls_are_answered_at_a_time_and_one_more_is_refused():
    session, sent, go = ClientSession(), Record(), asyncio.Event()

    async def answer(request):
        await go.wait()
        return TriggerResponse(success=True)

    providing = ServiceProvider(session, sent, lambda: False)
    providing.serve("/work", "std_srvs/Trigger", TriggerRequest, answer)
    for number in range(MAX_CALLS):
        session.called(CallService(service="/work", id=number))
    with pytest.raises(ProtocolError, match=f"/work cannot be called: {MAX_CALLS} calls are being answered"):
        session.called(CallService(service="/work", id="one too many"))
    go.set()
    await sent.reach(MAX_CALLS)
    assert {each.id for each in sent} == set(range(MAX_CALLS))
    await asyncio.sleep(0)
    session.called(CallService(service="/work", id="again"))
    await sent.reach(MAX_CALLS + 1)
    await providing.on_lost()
