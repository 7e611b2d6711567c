#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Records signals of a machine in each of its scans, over DDS, and writes them as CSV or as an Arrow file (docs/dds.md).

    nc_trace.py --machine mill3 nc.feed D10 --samples 5000 --out now.arrow
    nc_trace.py --machine mill3 door M100 --trigger door --when fall --before 500 --out door.csv
    nc_trace.py --machine mill3 --last --out night.arrow       the recording that is there

Arrow needs pyarrow (`pip install pyarrow`); CSV needs nothing but the binding of Cyclone DDS. Exit status: 0 done, 1 refused, or not possible.
"""
import argparse
import csv
import os
import sys
import time

import nc_dds
from cyclonedds.domain import DomainParticipant


class ArrowMissing(Exception):
    """pyarrow cannot be imported."""


def begin(services, signals, **plan):
    """Begins a recording of the signals; `plan`: samples, trigger, when, level, before, as of trace.arm. Returns its number."""
    return services.call("trace.arm", signals=signals, **plan)["recording"]


def collect(services, wait=True):
    """The newest recording as (status, rows), status as of trace.status, rows with scan, time_s and values. Waits for its end."""
    while True:
        status = services.call("trace.status")
        if status["state"] == "none":
            raise nc_dds.ServiceRefused("trace.status", "not found", "nothing has been recorded")
        if status["state"] in ("complete", "stopped"):
            return status, list(services.pages("trace.read", "rows", recording=status["recording"]))
        if not wait:
            raise nc_dds.ServiceRefused("trace.status", "refused", "the recording has not ended")
        time.sleep(0.05)


def table(status, rows):
    """A recording as a table of pyarrow: scan (uint64), time_s (double), and each signal (int32); what is known of it is in the metadata."""
    try:
        import pyarrow
    except ImportError as error:
        raise ArrowMissing(f"Arrow needs pyarrow, which is not installed: pip install pyarrow ({error})") from error
    fields = [pyarrow.field("scan", pyarrow.uint64(), False), pyarrow.field("time_s", pyarrow.float64(), False)]
    fields += [pyarrow.field(name, pyarrow.int32(), False) for name in status["signals"]]
    columns = [[row["scan"] for row in rows], [row["time_s"] for row in rows], *([row["values"][i] for row in rows] for i in range(len(status["signals"])))]
    about = {name: str(status[name]) for name in ("recording", "user", "client", "trigger", "when", "level", "cycle_us", "triggered", "trigger_row", "trigger_ns") if name in status}
    arrays = [pyarrow.array(values, field.type) for values, field in zip(columns, fields)]
    return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields, metadata=about))


def write_arrow(path, status, rows):
    """An IPC file, as Arrow calls it ("Feather V2")."""
    whole = table(status, rows)
    import pyarrow

    with pyarrow.OSFile(path + ".new", "wb") as file, pyarrow.ipc.new_file(file, whole.schema) as writer:
        writer.write_table(whole)
    os.replace(path + ".new", path)


def write_csv(path, status, rows):
    """The same columns as `ncctl trace record`."""
    with open(path + ".new", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scan", "time_s", *status["signals"]])
        writer.writerows([row["scan"], f"{row['time_s']:.9f}", *row["values"]] for row in rows)
    os.replace(path + ".new", path)


def main():
    parser = argparse.ArgumentParser(description="Records signals of a machine over DDS.", epilog="--out NAME.csv or NAME.arrow")
    parser.add_argument("signals", nargs="*", help="signals, points and devices of the ladder, at most 64")
    parser.add_argument("--machine", required=True, help="name of the control, as ncrtd --share")
    parser.add_argument("--domain", type=int, default=0)
    parser.add_argument("--client", default=f"trace-{os.getpid()}", help="name of this client, which no other one has")
    parser.add_argument("--samples", type=int)
    parser.add_argument("--before", type=int, help="how many of them from before the trigger")
    parser.add_argument("--trigger", help="one of the signals")
    parser.add_argument("--when", choices=("rise", "fall", "high", "low", "change"))
    parser.add_argument("--level", type=int)
    parser.add_argument("--last", action="store_true", help="the recording that is there, instead of a new one")
    parser.add_argument("--out", required=True, help="file that ends in .arrow or .csv")
    options = parser.parse_args()
    if bool(options.signals) == options.last:
        parser.error("give signals, or --last")
    kinds = {".csv": write_csv, ".arrow": write_arrow}
    write = kinds.get(os.path.splitext(options.out)[1])
    if write is None:
        parser.error("--out must end in .csv or .arrow")
    try:
        if write is write_arrow:
            table({"signals": []}, [])  # before the machine records for nothing
        services = nc_dds.Services(DomainParticipant(options.domain), options.machine, options.client)
        if options.signals:
            plan = {name: getattr(options, name) for name in ("samples", "before", "trigger", "when", "level") if getattr(options, name) is not None}
            begin(services, options.signals, **plan)
        write(options.out, *collect(services))
    except (nc_dds.ServiceRefused, ArrowMissing, OSError) as error:
        print(f"nc_trace.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
