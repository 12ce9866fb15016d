"""Breadth-first searches of a program's states, on one machine and on Apache Spark."""
