"""The first tables."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Bring the tables to this revision."""
    op.create_table("facts", _name(), _text("value"))
    op.create_table("settings", _name(), _text("value"))
    op.create_table(
        "places",
        _id(),
        *map(_text, ("name", "kind", "floor")),
        sa.Column("x", sa.Double(), nullable=False),
        sa.Column("y", sa.Double(), nullable=False),
        sa.Column("yaw", sa.Double(), nullable=True),
        *map(_text, ("tag", "note")),
    )
    op.create_table("answers", _id(), *map(_text, ("sender", "service", "command_id", "content")))
    op.create_table("missions", _id(), *map(_text, ("name", "content")))
    op.create_table("schedule", _id(), sa.Column("enabled", sa.Boolean(), nullable=False), _text("content"))
    op.create_table("queue", _id(), sa.Column("position", sa.Integer(), nullable=False), _text("content"))
    op.create_table(
        "runs",
        _id(),
        _text("task"),
        *map(_instant, ("started", "ended")),
        *map(_text, ("state", "reason")),
        sa.Column("distance", sa.Double(), nullable=False),
        sa.Column("visited", sa.Integer(), nullable=False),
        *map(_text, ("started_by", "content")),
    )
    op.create_table(
        "events",
        _id(),
        _instant("stamp"),
        *map(_text, ("level", "kind", "text")),
        *(sa.Column(axis, sa.Double(), nullable=True) for axis in "xyz"),
        _text("acknowledged_by"),
        _instant("acknowledged"),
    )


def _id() -> sa.Column[int]:
    return sa.Column("id", sa.Integer(), primary_key=True, autoincrement=False)


def _name() -> sa.Column[str]:
    return sa.Column("name", sa.String(64), primary_key=True)


def _text(name: str) -> sa.Column[str]:
    return sa.Column(name, sa.Text(), nullable=False)


def _instant(name: str) -> sa.Column[int]:
    return sa.Column(name, sa.BigInteger(), nullable=False)
