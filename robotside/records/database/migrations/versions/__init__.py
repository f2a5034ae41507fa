"""Each step one file; alembic finds them by the revisions they name."""
