"""The run of the migrations by alembic: over the connection that it gets, within the open transaction."""

from __future__ import annotations

from alembic import context

from robotside.records.database.tables import Base

connection = context.config.attributes.get("connection")
if connection is None:
    raise RuntimeError("These migrations are run by robotside.records.opening, which hands in a connection.")
context.configure(connection=connection, target_metadata=Base.metadata)
with context.begin_transaction():
    context.run_migrations()
