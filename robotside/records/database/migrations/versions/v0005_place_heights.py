"""Heights of places, for robots that swim or fly."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Bring the tables to this revision. What is older has no height: NULL."""
    op.add_column("places", sa.Column("height", sa.Double(), nullable=True))
