# SPDX-License-Identifier: Apache-2.0
"""Finds the ncsim that is measured: bench/peer.py knows where it can be."""
import os
import sys

sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import peer  # noqa: E402


def ncsim(named=None):
    return peer.find_ncsim(named)
