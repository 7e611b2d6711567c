# SPDX-License-Identifier: Apache-2.0
"""Finds the ncsim that is to be measured, as bench/peer.py does."""
import os
import sys

sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import peer  # noqa: E402


def ncsim(named=None):
    return peer.find_ncsim(named)
