#!/usr/bin/env python3
"""The corpus of a fuzz target as one file, tests/fuzz/corpus/TARGET.corpus, and as the folder of files that libFuzzer takes.

usage: corpus.py unpack TARGET FOLDER
       corpus.py pack TARGET FOLDER
       corpus.py seed TARGET FOLDER     what a fresh corpus begins with: the contract's examples, and little sound ones
"""
import base64
import hashlib
import json
import pathlib
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "proto" / "examples"

# The kinds of examples in the order of the first byte that the target chooses by; without: no such byte.
CHOSEN = {
    "settings_files": ["camera", "scans", "world", "scenario", "rosbridge", "tour"],
    "request_bodies": ["edits", "sweep", "reason", "mission", "problem"],
}
SOUND = {
    "addresses": [b"http://127.0.0.1:8080", b"https://house.example", b"ws://[::1]:9090/rosbridge?a=b", b"wss://chair.example"],
    "http_requests": [
        b"\x07PUT /api/a%20b?q=%41 HTTP/1.1\r\nHost: me:8080\r\nTransfer-Encoding: chunked\r\n\r\n4;x=y\r\nWiki\r\n0\r\n\r\n",
        b"\xffPOST / HTTP/1.1\r\nHost: [::1]\r\nContent-Length: 3\r\nCookie: homeward_session=a\r\nOrigin: http://me\r\n\r\nabc",
        b"\x20GET / HTTP/1.1\r\nHost: a\r\nX-Forwarded-For: 1.2.3.4, ::1\r\nX-Forwarded-Proto: https\r\n"
        b"If-None-Match: W/\"r1\", \"r2\"\r\n\r\n"],
    "ros_messages": [
        b'\x00{"op":"publish","topic":"/scan","msg":{"header":{"stamp":{"sec":1,"nanosec":2}},"angle_min":-1.5,'
        b'"angle_increment":0.1,"range_min":0.05,"range_max":12,"ranges":[1,null,2.5]}}',
        b'\x00{"op":"publish","topic":"/odom","msg":{"header":{"stamp":{"secs":1,"nsecs":2}},"pose":{"pose":{"position":'
        b'{"x":1,"y":2,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}}},"twist":{"twist":{"linear":{"x":0.1},"angular":{"z":0}}}}}',
        b'\x00{"op":"publish","topic":"/image","msg":{"header":{"stamp":{"sec":1,"nanosec":2}},"format":"jpeg","data":"/9j/4AA="}}',
        b'\x00{"op":"publish","topic":"/cmd_vel","msg":{"linear":{"x":0.1,"y":0,"z":0},"angular":{"x":0,"y":0,"z":0.2}}}',
        b'\x01{"op":"publish","topic":"/sonar/0","msg":{"header":{"stamp":{"sec":1,"nanosec":2}},"field_of_view":0.6,'
        b'"min_range":0.1,"max_range":3,"range":1.25}}',
        b'\x00{"op":"status","level":"error","msg":"no such topic"}'],
    "tables": [b"\x00filename,t_us\na.jpg,1\n", b"\x01P5\n# floor\n2 2\n255\nabcd", b"\x02filename,t_us\na.jpg,1\nb.jpg,2\n",
               b"\x03t_us,x_m,y_m,theta_rad\n1,0,0,0\n2,1.5,-0.25,3\n", b'\x04{"marks":[{"image":"a.jpg","label":"hall"}]}',
               b"\x05filename,r0,r1,r2\na.jpg,1.25,,12.000\n"],
    "drawn_plans": [
        b"\x00#VRML V2.0 utf8\nDEF P Transform { translation 1 2 3 rotation 0 0 1 1.5 center 1 0 0 scale 2 2 1 scaleOrientation 1 0 0 1\n"
        b"children [ Shape { geometry IndexedLineSet { coord DEF C Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }\n"
        b"coordIndex [ 0 1 2 3 0 -1 1 2 -1 ] } } ] }\nShape { geometry IndexedFaceSet { coord USE C coordIndex [ 0 1 2 -1 0 1 2 3 ] } }\nUSE P\n",
        b"\x01#VRML V2.0 utf8\nPROTO X [ field SFFloat a 1 ] { Group { } }\nEXTERNPROTO Y [ ] [ \"y.wrl\" ]\n"
        b"DEF S Switch { whichChoice 0 choice [ LOD { range [ 5 ] level [ Shape { geometry Box { size 1 2 3 } } ] } ] }\n"
        b"ROUTE S.a TO S.b\nScript { url \"javascript:\" eventIn SFBool f }\nAnchor { children Billboard { children USE S } }\n"
        b"Shape { appearance NULL geometry Text { string \"a\\\"b\" } }\nCollision { collide TRUE children [ ] } # end",
        b"\x00#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { convex FALSE coord Coordinate { point [ 0 0 0 2 0 0 2 1 0 1 1 0 1 2 0 0 2 0 ] }\n"
        b"coordIndex [ 0 1 2 3 4 5 -1 5 3 1 0 -1 ] } }",
        b"\x02<svg xmlns='http://www.w3.org/2000/svg' width='10m' viewBox='0 0 100 80'>\n<g transform='translate(1 2) rotate(30, 1 1) scale(2)'>"
        b"<path d='M0 0h10v-5l1,1 .5-.5C1 2 3 4 5 6A1 1 0 0 1 9 9z m1 1 2 2'/></g><rect x='1' y='2' width='30' height='20'/>"
        b"<polyline points='0,0 1,1 2 0'/><polygon points='0 0 9 0 9 9'/><line x1='1' x2='2px' y1='0' y2='3'/></svg>",
        b"\x02<!DOCTYPE svg [<!ENTITY a 'M0 0L9 9'>]><svg><g display='none' transform='matrix(1 0 0 1 2 3) skewX(9)'><path d='M0 0H1'/></g>"
        b"<path d='&a;'/><defs/><text>a</text></svg>", b"\x02<svg><use href='#a'/></svg>",
        b"\x00#VRML V2.0 utf8\nInline { url \"a.wrl\" }", b"\x00#VRML V1.0 ascii\n",
        b"\x00#VRML V2.0 utf8\nShape { geometry IndexedLineSet { coord Coordinate { point [ 0 0 0 1e5 -1.5e-3 +0.5 ] } coordIndex [ 0 1 7 ] } }"],
    "recorded_texts": [b"\x00{}", b"\x01{}", b"\x02{}"],
    "appearances": [bytes(6), b"\x00" + bytes([0, 0, 0, 44, 7])],
    "pictures": [bytes(7), b"\x01" + bytes(6), b"\x00\x00" + bytes([0, 0, 0, 160, 7])],
    "map_files": [bytes(6), b"\x00" + bytes([0, 0, 0, 18, 2])],
    "recordings": [bytes(6), b"\x00" + bytes([0, 0, 0, 18, 2])],
}


def packed(target):
    return HERE / "corpus" / f"{target}.corpus"


def inputs_of(target):
    data = packed(target).read_bytes()
    at = 0
    while at < len(data):
        (length,) = struct.unpack_from("<I", data, at)
        yield data[at + 4:at + 4 + length]
        at += 4 + length


def cbor(value):
    """As the agent link writes it (RFC 8949): definite lengths, floating point numbers of 64 bits."""
    def head(major, count):
        if count < 24:
            return bytes([major << 5 | count])
        size = 0 if count < 1 << 8 else 1 if count < 1 << 16 else 2 if count < 1 << 32 else 3
        return bytes([major << 5 | 24 + size]) + struct.pack(">" + "BHIQ"[size], count)
    if value is None or value is True or value is False:
        return {None: b"\xf6", True: b"\xf5", False: b"\xf4"}[value]
    if isinstance(value, int):
        return head(0, value) if value >= 0 else head(1, -1 - value)
    if isinstance(value, float):
        return b"\xfb" + struct.pack(">d", value)
    if isinstance(value, str):
        return head(3, len(value.encode())) + value.encode()
    if isinstance(value, list):
        return head(4, len(value)) + b"".join(map(cbor, value))
    if isinstance(value, bytes):
        return head(2, len(value)) + value
    return head(5, len(value)) + b"".join(cbor(key) + cbor(one) for key, one in value.items())


def with_bytes(value):
    """JSON writes as base64 what the agent link sends as it is."""
    if isinstance(value, list):
        return [with_bytes(one) for one in value]
    if not isinstance(value, dict):
        return value
    return {key: base64.b64decode(one) if key in ("jpeg", "appearance") else with_bytes(one) for key, one in value.items()}


def seeds_of(target):
    if target == "link_messages":
        for file in sorted(EXAMPLES.glob("link_*/valid/*.json")):
            message = cbor(with_bytes(json.loads(file.read_text())))
            yield b"\x00" + message
            yield b"\x01" + message
    for first, kind in enumerate(CHOSEN.get(target, [])):
        for file in sorted((EXAMPLES / kind).glob("*/*.json")):
            yield bytes([first]) + file.read_bytes()
    yield from SOUND.get(target, [])


def put(folder, inputs):
    folder.mkdir(parents=True, exist_ok=True)
    for data in inputs:
        (folder / hashlib.sha1(data).hexdigest()).write_bytes(data)


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in ("pack", "unpack", "seed"):
        sys.exit(__doc__)
    what, target, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    if what == "unpack":
        put(folder, inputs_of(target))
    elif what == "seed":
        put(folder, seeds_of(target))
    else:
        data = [file.read_bytes() for file in sorted(folder.iterdir())]
        packed(target).write_bytes(b"".join(struct.pack("<I", len(one)) + one for one in data))
        print(f"{packed(target).name}: {len(data)} inputs")


if __name__ == "__main__":
    main()
