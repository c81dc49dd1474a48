"""Runs the experiment: settings and folder, Snakemake, and the report of what came out."""
