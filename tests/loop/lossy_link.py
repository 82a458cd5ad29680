#!/usr/bin/env python3
"""A TCP proxy that behaves as a bad radio link does to those at its ends: so many bytes a second each way, each packet late by
up to a jitter, and of the packets a share lost, which TCP sends again: all that follows waits that long.

usage: lossy_link.py LISTEN_PORT TARGET_PORT BYTES_PER_S JITTER_S LOSS [SEED]
"""
import asyncio
import random
import socket
import sys

HOST = "127.0.0.1"
PACKET = 1448
SENT_AGAIN_S = 0.2  # the least time after which Linux sends again
BUFFER = 16384      # as little as a radio's: what waits, waits at the sender


class Link:
    def __init__(self, target, bytes_per_s, jitter_s, loss, seed):
        self.target, self.bytes_per_s, self.jitter_s, self.loss = target, bytes_per_s, jitter_s, loss
        self.random = random.Random(seed)

    async def carry(self, reader, writer):
        """Packets keep their order: one that is late or lost makes those behind it late."""
        loop = asyncio.get_running_loop()
        queue = asyncio.Queue(maxsize=BUFFER // PACKET)

        async def take():
            while data := await reader.read(PACKET):
                late = self.random.uniform(0, self.jitter_s)
                lost = SENT_AGAIN_S if self.random.random() < self.loss else 0
                await queue.put((loop.time() + late + lost, data))
            await queue.put((0, b""))

        async def give():
            free_at = loop.time()
            while True:
                due, data = await queue.get()
                if not data:
                    break
                free_at = max(free_at, due) + len(data) / self.bytes_per_s
                await asyncio.sleep(max(0.0, free_at - loop.time()))
                writer.write(data)
                await writer.drain()
            writer.close()

        await asyncio.gather(take(), give())

    async def serve(self, reader, writer):
        plain = socket.socket()
        plain.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
        plain.setblocking(False)
        await asyncio.get_running_loop().sock_connect(plain, (HOST, self.target))
        far_reader, far_writer = await asyncio.open_connection(sock=plain, limit=BUFFER)
        for end in (writer, far_writer):
            end.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)
            end.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        await asyncio.gather(self.carry(reader, far_writer), self.carry(far_reader, writer), return_exceptions=True)


async def main():
    if len(sys.argv) not in (6, 7):
        sys.exit(__doc__)
    listen, target = int(sys.argv[1]), int(sys.argv[2])
    link = Link(target, *map(float, sys.argv[3:6]), int(sys.argv[6]) if len(sys.argv) == 7 else 1)
    async with await asyncio.start_server(link.serve, HOST, listen, limit=BUFFER) as server:
        print("carries", flush=True)
        await server.serve_forever()


if __name__ == "__main__":
    asyncio.run(main())
