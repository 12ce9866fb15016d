"""The version of the package: that of Dolphin."""

VERSION = "0.1.0"
