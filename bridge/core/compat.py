"""Compatibility with the rosbridge servers in use, where they differ from their specification."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Compat"]


@dataclass(frozen=True, slots=True)
class Compat:
    """The habits of the servers in use that are kept. The defaults are those that today's clients depend on."""

    refusal_as_success: bool = True
    """A client that answers a call of its service with `result: false` reaches the caller as `result: true`, with the
    values it gave.

    Both servers in use do so: for them the exchange succeeded, and the failure stands in the values. Users of roslibpy
    read the values in their ordinary callback and would get an empty error instead. A refusal without any values, or
    with a sentence in their place, remains one, because a reader of values could not handle it. When False the caller
    gets the provider's `result: false`.
    """
    missing_values_as_defaults: bool = True
    """An answer with `result: true` and without `values` counts as a response of defaults.

    Services without a response leave `values` out, and the ROS 1 server then never answers the caller, who waits for
    ever. When False the caller gets `result: false` at once, because the answer was incomplete.
    """
    shortest_queue: bool = True
    """Of several `queue_length`s of a client for one topic the shortest counts.

    The specification says the longest. With the shortest, as in the servers in use, a client that asks for 1 to be up
    to date stays so even when other parts of its page ask for more. When False the longest counts, and 0, which leaves
    the length to the server, before all.
    """
    sticky_fragment_size: bool = True
    """A `fragment_size` in any operation holds for everything sent to that client from then on; null ends it.

    The specification has it for the one subscription or call. Clients behind something that cuts long frames say it
    once and count on it for the answers of services too. When False it holds for what it came with.
    """
    unknown_compression_as_none: bool = True
    """An unknown `compression` counts as `none`, which every client can read.

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
