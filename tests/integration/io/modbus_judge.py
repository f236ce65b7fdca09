#!/usr/bin/env python3
"""The other side of our Modbus, by another implementation of the protocol: pymodbus.
modbus_judge.py server tcp|rtu ADDRESS PORT: a device; rtu: with the frames of a serial line. Reads commands:
  set holding NUMBER VALUE | get holding NUMBER
modbus_judge.py client ADDRESS PORT: asks. Reads commands:
  read coil|discrete|input|holding FIRST COUNT | write coil|holding FIRST VALUES... | mask FIRST AND OR
  both READ COUNT WRITE VALUES... | raw HEX (the answer's bytes, or nothing) | leave
Each is answered by one line."""

import socket
import sys
import threading
import time

from pymodbus.client import ModbusTcpClient
from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartTcpServer

try:
    from pymodbus.framer import FramerType  # 3.6 and later: Debian 13
    RTU, SOCKET = FramerType.RTU, FramerType.SOCKET
    WRITTEN = "values"  # of readwrite_registers
except ImportError:
    from pymodbus.transaction import ModbusRtuFramer as RTU, ModbusSocketFramer as SOCKET
    WRITTEN = "write_registers"

HOLDING = 3  # function code by which the data store knows its tables
PLACES = 200


def say(text):
    print(text, flush=True)


def serve(framing, address, port):
    block = ModbusSequentialDataBlock(1, [0] * PLACES)
    store = ModbusSlaveContext(di=block, co=block, hr=ModbusSequentialDataBlock(1, [0] * PLACES), ir=block)
    framer = RTU if framing == "rtu" else SOCKET
    threading.Thread(target=StartTcpServer, daemon=True, kwargs={
        "context": ModbusServerContext(slaves=store, single=True), "framer": framer, "address": (address, port)}).start()
    while True:
        try:
            socket.create_connection((address, port), 1).close()
            break
        except OSError:
            time.sleep(0.01)
    say("ready")
    for line in sys.stdin:
        word, _, number, *value = line.split()
        if word == "set":
            store.setValues(HOLDING, int(number), [int(value[0])])
        say(f"holding {number} = {store.getValues(HOLDING, int(number), 1)[0]}")


def answer(result, count=0):
    if result.isError():
        return f"exception {getattr(result, 'exception_code', result)}"
    values = getattr(result, "registers", None) or getattr(result, "bits", None) or []
    return "ok " + " ".join(str(int(value)) for value in values[:count])


def ask(address, port):
    client = ModbusTcpClient(address, port=port, timeout=5)
    while not client.connect():
        time.sleep(0.01)
    reads = {"coil": client.read_coils, "discrete": client.read_discrete_inputs, "input": client.read_input_registers,
             "holding": client.read_holding_registers}
    say("ready")
    for line in sys.stdin:
        word, *rest = line.split()
        if word == "read":
            say(answer(reads[rest[0]](int(rest[1]), count=int(rest[2]), slave=1), int(rest[2])))
        elif word == "write":
            values = [int(value) for value in rest[2:]]
            if rest[0] == "coil":
                result = client.write_coil(int(rest[1]), values[0] != 0, slave=1) if len(values) == 1 else \
                    client.write_coils(int(rest[1]), [value != 0 for value in values], slave=1)
            else:
                result = client.write_register(int(rest[1]), values[0], slave=1) if len(values) == 1 else \
                    client.write_registers(int(rest[1]), values, slave=1)
            say(answer(result))
        elif word == "mask":
            say(answer(client.mask_write_register(address=int(rest[0]), and_mask=int(rest[1], 16),
                                                  or_mask=int(rest[2], 16), slave=1)))
        elif word == "both":
            read, count, write, *values = [int(value) for value in rest]
            say(answer(client.readwrite_registers(read_address=read, read_count=count, write_address=write,
                                                  slave=1, **{WRITTEN: values}), count))
        elif word == "raw":
            with socket.create_connection((address, port), 5) as connection:
                connection.sendall(bytes.fromhex(rest[0]))
                say("answer " + connection.recv(300).hex())
        elif word == "leave":
            client.close()
            say("left")
            return


if sys.argv[1] == "server":
    serve(sys.argv[2], sys.argv[3], int(sys.argv[4]))
else:
    ask(sys.argv[2], int(sys.argv[3]))
