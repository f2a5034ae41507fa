"""Codes of events and of what became of tasks, beside their sentences."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Bring the tables to this revision. What is older has no code: NULL."""
    for table in ("events", "runs"):
        for name in ("code", "actor_id", "parameters"):
            op.add_column(table, sa.Column(name, sa.Text(), nullable=True))
