# SPDX-License-Identifier: Apache-2.0
# Modbus RTU devices made of pymodbus on a serial line, for rtu_test.py, which runs it in a virtual environment of its own.
#   pymodbus_serial.py LINE BAUD PARITY '{"1": {"coil": [..], "holding": [..]}, "2": {...}}'
import asyncio
import json
import sys

from pymodbus.framer import FramerType
from pymodbus.server import ModbusSerialServer

from pymodbus_server import device


async def main():
    line, baud, parity, units = sys.argv[1:]
    devices = [device(int(unit), tables) for unit, tables in json.loads(units).items()]
    server = ModbusSerialServer(devices, framer=FramerType.RTU, port=line, baudrate=int(baud), parity=parity, stopbits=1, bytesize=8)
    print("ready", flush=True)
    await server.serve_forever()


asyncio.run(main())
