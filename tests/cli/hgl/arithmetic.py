# SPDX-License-Identifier: Apache-2.0
"""Numbers and texts of a stream, and the arithmetic decoder with its models."""
import struct


class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]

    def text(self):
        length = self.take("I")
        self.at += length
        return self.data[self.at - length:self.at].decode()


class Model:
    def __init__(self, zero=32768):
        self.a = self.b = zero


class Models(dict):
    """A model for each name; it starts in the state of that name when it is first used."""

    def __init__(self, states=None):
        self.states = states or {}

    def __missing__(self, name):
        self[name] = Model(round(65536 / (1 + 2**(-self.states.get(name, 0) / 4))))
        return self[name]


class Decoder:
    def __init__(self, data):
        self.data, self.at, self.range, self.code = data, 0, 2**32 - 1, 0
        for _ in range(4):
            self.code = self.code << 8 | self.byte()

    def byte(self):
        self.at += 1
        return self.data[self.at - 1] if self.at <= len(self.data) else 0

    def narrow(self, start, size):
        self.code -= start
        self.range = size
        while self.range < 2**24:
            self.range <<= 8
            self.code = self.code << 8 | self.byte()

    def bit(self, model):
        zero = (self.range >> 16) * ((model.a + model.b) // 2)
        if self.code < zero:
            self.narrow(0, zero)
            model.a += (65536 - model.a) >> 4
            model.b += (65536 - model.b) >> 7
            return 0
        self.narrow(zero, self.range - zero)
        model.a -= model.a >> 4
        model.b -= model.b >> 7
        return 1

    def even(self):
        half = self.range >> 1
        value = min(self.code // half, 1)
        self.narrow(half * value, half)
        return value

    def raw(self, count):
        value = 0
        for done in range(0, count, 16):
            bits = min(16, count - done)
            unit = self.range >> bits
            part = min(self.code // unit, 2**bits - 1)
            self.narrow(unit * part, unit)
            value |= part << done
        return value

    def number(self, models, name):
        bits = 0
        while bits < 30 and self.bit(models[name, bits]):
            bits += 1
        value = 1
        for _ in range(bits):
            value = value << 1 | self.even()
        return value - 1
