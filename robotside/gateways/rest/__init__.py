"""REST: a robot's resources on its web site as JSON, XML and text, with OpenAPI, streams of topics, and webhooks."""
