#!/usr/bin/env python3
"""TLS in front of a plain server, as an operator's proxy gives it: what comes in is decrypted and passed on, as it is.

usage: tls_front.py LISTEN_PORT TARGET_PORT CERTIFICATE KEY
"""
import asyncio
import ssl
import subprocess
import sys

HOST = "127.0.0.1"


def make_certificate(name, certificate, key):
    """A certificate of its own for that host name, which is trusted by whoever is told to trust it."""
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days",
                    "2", "-subj", f"/CN={name}", "-addext", f"subjectAltName=DNS:{name}", "-out", certificate, "-keyout", key],
                   check=True, stderr=subprocess.DEVNULL)


async def carry(reader, writer):
    try:
        while data := await reader.read(65536):
            writer.write(data)
            await writer.drain()
    finally:
        writer.close()


async def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    listen, target = int(sys.argv[1]), int(sys.argv[2])
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(sys.argv[3], sys.argv[4])

    async def serve(reader, writer):
        far_reader, far_writer = await asyncio.open_connection(HOST, target)
        await asyncio.gather(carry(reader, far_writer), carry(far_reader, writer), return_exceptions=True)

    async with await asyncio.start_server(serve, HOST, listen, ssl=context) as server:
        await server.serve_forever()


if __name__ == "__main__":
    asyncio.run(main())
