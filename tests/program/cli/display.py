"""Receives what a display server is sent, and says what the packets hold: display.py PORTFILE PICTURES [PACKETS].

The first connection's packets are read to their end, each by the layout of tev's protocol, every byte accounted for; then the
picture is written to PICTURES as PFM. With PACKETS, the bytes are kept there."""
import array
import socket
import struct
import sys


class Packet:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]

    def text(self):
        end = self.data.index(b"\0", self.at)
        text = self.data[self.at:end].decode()
        self.at = end + 1
        return text


def main():
    server = socket.create_server(("127.0.0.1", 0))
    with open(sys.argv[1], "w") as file:
        print(server.getsockname()[1], file=file)
    connection = server.accept()[0]
    received = bytearray()
    while True:
        data = connection.recv(1 << 16)
        if not data:
            break
        received += data
    if len(sys.argv) > 3:
        with open(sys.argv[3], "wb") as file:
            file.write(received)
    counts, at, size, names, values = {}, 0, None, None, None
    while at < len(received):
        (length,) = struct.unpack_from("<I", received, at)
        packet = Packet(bytes(received[at:at + length]))
        at += length
        packet.take("I")
        kind = packet.take("B")
        counts[kind] = counts.get(kind, 0) + 1
        if kind == 2:
            print("close", packet.text())
            assert values is None, "the picture is closed"
        elif kind == 4:
            focus, name = packet.take("B"), packet.text()
            size = packet.take("ii")
            names = [packet.text() for _ in range(packet.take("i"))]
            print("create", focus, name, *size, ",".join(names))
            values = {n: array.array("f", bytes(4 * size[0] * size[1])) for n in names}
        else:
            assert kind == 6, kind
            focus, name = packet.take("B"), packet.text()
            channels = [packet.text() for _ in range(packet.take("i"))]
            x, y, width, height = packet.take("iiii")
            count = len(channels)
            offsets, strides = [packet.take(f"{count}q") for _ in range(2)]
            data = array.array("f", packet.data[packet.at:])
            packet.at += 4 * (max(offsets) + (width * height - 1) * max(strides) + 1)
            assert focus == 0 and 0 <= x and x + width <= size[0] and 0 <= y and y + height <= size[1]
            for channel, offset, stride in zip(channels, offsets, strides):
                for row in range(height):
                    line = data[offset + row * width * stride:offset + ((row + 1) * width - 1) * stride + 1:stride]
                    values[channel][(y + row) * size[0] + x:(y + row) * size[0] + x + width] = line
        assert packet.at == length, f"{packet.at} bytes of {length}"
    print("updates", counts.get(6, 0))
    with open(sys.argv[2], "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % size)
        for row in reversed(range(size[1])):
            line = [values[n][row * size[0] + x] for x in range(size[0]) for n in ("R", "G", "B")]
            file.write(struct.pack("<%df" % len(line), *line))


main()
