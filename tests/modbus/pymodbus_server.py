# SPDX-License-Identifier: Apache-2.0
# A Modbus TCP server made of pymodbus, for pymodbus_test.py, which runs it in a virtual environment of its own.
#   pymodbus_server.py PORT '{"1": {"coil": [..], "discrete": [..], "holding": [..], "input": [..]}, "2": {...}}'
# Every list begins at address 0; what is behind it does not exist.
import asyncio
import json
import sys

from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice


def bits(values):
    return [SimData(0, values=[bool(v) for v in values], datatype=DataType.BITS)]


def registers(values):
    return [SimData(0, values=values, datatype=DataType.REGISTERS)]


def device(unit, tables):
    return SimDevice(id=unit, simdata=(bits(tables.get("coil", [0])), bits(tables.get("discrete", [0])),
                                       registers(tables.get("holding", [0])), registers(tables.get("input", [0]))))


async def main():
    units = [device(int(unit), tables) for unit, tables in json.loads(sys.argv[2]).items()]
    await ModbusTcpServer(units, address=("127.0.0.1", int(sys.argv[1]))).serve_forever()


if __name__ == "__main__":
    asyncio.run(main())
