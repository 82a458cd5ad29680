#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How often `homeward retrieve` names a picture taken near the query, by the true poses of both tours.

usage: retrieval_by_poses.py retrieved.jsonl QUERY_TOUR GALLERY_TOUR [--within 1.0]
Queries without any picture of the gallery within that distance are left out.
"""
import argparse
import csv
import json
import math
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("retrieved", type=Path)
parser.add_argument("query_tour", type=Path)
parser.add_argument("gallery_tour", type=Path)
parser.add_argument("--within", type=float, default=1.0, help="metres")
arguments = parser.parse_args()


def poses(tour):
    with open(tour / "poses.csv", newline="") as file:
        return {row["filename"]: (float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(file)}


asked, seen = poses(arguments.query_tour), poses(arguments.gallery_tour)
answers = [json.loads(line) for line in arguments.retrieved.read_text().splitlines()]
hits, queries = {1: 0, 5: 0, 10: 0}, 0
for answer in answers:
    here = asked[Path(answer["query"]).name]
    if min(math.dist(here, there) for there in seen.values()) > arguments.within:
        continue
    queries += 1
    right = [math.dist(here, seen[Path(one["image"]).name]) <= arguments.within for one in answer["top"][:10]]
    for count in hits:
        hits[count] += any(right[:count])
milliseconds = sorted(answer["ms"] for answer in answers)
print(json.dumps({"queries": queries, **{f"recall_{k}": round(v / max(1, queries), 4) for k, v in hits.items()},
                  "ms_p50": milliseconds[len(milliseconds) // 2]}))
