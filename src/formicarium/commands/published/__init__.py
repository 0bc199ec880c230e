"""The published study of task sequencing: its campaigns joined to its tables, figures and report."""
