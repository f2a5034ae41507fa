"""Pictures of intruders."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Bring the tables to this revision."""
    op.create_table(
        "crops",
        sa.Column("id", sa.Integer(), primary_key=True, autoincrement=False),
        sa.Column("picture", sa.Text(), nullable=False),
    )
