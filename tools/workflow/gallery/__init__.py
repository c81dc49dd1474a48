"""The gallery of an experiment: a static site and a PDF, made of the folder that tools/experiment writes."""
