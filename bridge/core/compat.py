"""Where the rosbridge servers in use do otherwise than their specification says, and what is done about it here."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Compat"]


@dataclass(frozen=True, slots=True)
class Compat:
    """Which habits of the servers in use are kept. As it comes it is what today's clients lean on."""

    refusal_as_success: bool = True
    """A client that answers a call of its service with `result: false` reaches the caller as `result: true`, with the
    values it gave.

    Both servers in use do so: for them the exchange went well, and what failed stands in the values. roslibpy's users
    read the values in their ordinary callback and would get an error with nothing in it instead. A refusal without
    any values, or with a sentence in their place, stays one: who reads values would stumble over it. When False the caller gets `result: false` as the provider
    said.
    """
    missing_values_as_defaults: bool = True
    """A client that answers a call with `result: true` and without `values` is taken to mean a response of defaults.

    Services without a response leave `values` out, and the ROS 1 server then never answers the caller, who waits for
    ever. When False the caller is told at once, by `result: false`, that the answer was incomplete.
    """
    shortest_queue: bool = True
    """Of several `queue_length`s of a client for one topic the shortest counts.

    The specification says the longest. With the shortest, which the servers in use take, a client that asks for 1 to be
    up to date stays so whatever other parts of its page ask for. When False the longest counts, and 0, which leaves
    the length to the server, before all.
    """
    sticky_fragment_size: bool = True
    """A `fragment_size` in any operation holds for everything sent to that client from then on; null ends it.

    The specification has it for the one subscription or call. Clients behind something that cuts long frames say it
    once and count on it for the answers of services too. When False it holds for what it came with.
    """
    unknown_compression_as_none: bool = True
    """A `compression` that nobody knows counts as `none`, which every client can read.

    When False the operation is refused with a sentence.
    """

    @classmethod
    def strict(cls) -> Compat:
        """The specification to the letter."""
        return cls(
            refusal_as_success=False,
            missing_values_as_defaults=False,
            shortest_queue=False,
            sticky_fragment_size=False,
            unknown_compression_as_none=False,
        )
