"""The summary over the materials: errors, their distributions and charts, where the worst come from, time and cost."""
