# SPDX-License-Identifier: Apache-2.0
"""Harmful and harmless drafts of edits for replay_check.py, drawn at random under a simulated tour's truth.

The truth is the tour's poses.csv (poses and rooms) and scans.csv: one picture's spot is in sight of another's where a sweep
passes over it. A draft is {"kind", "why", "edits", "places", "images", "pairs"}: the edits, in words what makes it harmful or
harmless, and what it harms: places, pictures, and the pairs of places whose way or route it is about.
"""

import csv
import functools
import heapq
import math
import random

ONE_SPOT_M = 0.8  # prototypes of two places that are one
BESIDE_M = 1.2
NEAR_M = 5.0  # half of what is wrong is drawn from so near, where it is hard to tell
FAR_M = 8.0
WAY_ROUND_M = 5.0  # at least so much longer is the way round a wall
DETOUR_M = 4.0  # at most so much longer is the way without a redundant one
BODY_M = 0.35
SLACK_M = 0.1  # of a sweep that ends at what it is about


class Truth:
    """A map's graph, and where its pictures were truly taken."""

    def __init__(self, tour, exported):
        self.tour = tour.name
        with open(tour / "poses.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.pose = {row["filename"]: tuple(float(row[key]) for key in ("x_m", "y_m", "theta_rad")) for row in rows}
        self.room_of = {row["filename"]: row.get("room") or "" for row in rows}
        with open(tour / "scans.csv", newline="") as file:
            self.ranges = {row[0]: [float(value or "inf") for value in row[1:]] for row in list(csv.reader(file))[1:]}
        self.order = {row["filename"]: number for number, row in enumerate(rows)}
        self.places = {place["id"]: [file_of(member) for member in place["members"]] for place in exported["places"]}
        self.prototype = {place["id"]: file_of(place["prototype"]) for place in exported["places"]}
        self.destinations = exported["destinations"]
        self.hypotheses = exported["hypotheses"]
        self.ways = frozenset(tuple(sorted((edge["from"], edge["to"]))) for edge in exported["edges"])

    def image(self, file):
        return f"{self.tour}/{file}"

    def room(self, place):
        """The room that all its pictures are in; empty where they are not in one."""
        rooms = {self.room_of[member] for member in self.places[place]}
        return rooms.pop() if len(rooms) == 1 else ""

    def between_m(self, a, b):
        """Of two pictures."""
        return math.dist(self.pose[a][:2], self.pose[b][:2])

    def apart_m(self, a, b):
        """Of the prototypes of two places."""
        return self.between_m(self.prototype[a], self.prototype[b])

    def past_m(self, file, other, half_width_m):
        """How far beyond another picture's spot a sweep saw nothing, in a strip; negative: something stands before it."""
        x, y, theta = self.pose[file]
        towards = math.atan2(self.pose[other][1] - y, self.pose[other][0] - x) - theta
        away = self.between_m(file, other)
        step = 2.0 * math.pi / len(self.ranges[file])
        past = math.inf
        for number, reach in enumerate(self.ranges[file]):
            off = math.remainder(number * step - towards, 2.0 * math.pi)
            if abs(off) < math.pi / 2 and abs(min(reach, away) * math.sin(off)) <= max(half_width_m, away * step / 2):
                past = min(past, reach * math.cos(off) - away)
        return past

    @functools.cache
    def in_sight(self, a, b, half_width_m=0.0):
        files = (self.prototype[a], self.prototype[b])
        return all(self.past_m(*pair, half_width_m) > -SLACK_M for pair in (files, files[::-1]))

    @functools.cache
    def walled(self, a, b):
        """Something stands between them, seen from both, and the way round it is long."""
        files = (self.prototype[a], self.prototype[b])
        hidden = all(self.past_m(*pair, 0.0) < -SLACK_M for pair in (files, files[::-1]))
        return hidden and self.ways_m(a, self.ways).get(b, math.inf) > self.apart_m(a, b) + WAY_ROUND_M

    @functools.cache
    def ways_m(self, start, ways):
        """The shortest ways over a graph to all that it reaches, by the true poses."""
        beside = neighbours(ways)
        reached, queue = {}, [(0.0, start)]
        while queue:
            way_m, place = heapq.heappop(queue)
            if place in reached:
                continue
            reached[place] = way_m
            for other in beside.get(place, ()):
                heapq.heappush(queue, (way_m + self.apart_m(place, other), other))
        return reached

    def parted(self, ways, without=None):
        """Pairs of destinations' places that these ways do not join, the destinations of one place left out."""
        part, beside = {}, neighbours(ways)
        for place in self.places:
            stack = [place] if place not in part else []
            while stack:
                here = stack.pop()
                if here not in part:
                    part[here] = place
                    stack += beside.get(here, ())
        at = sorted({one["place"] for one in self.destinations} - {without})
        return [(a, b) for number, a in enumerate(at) for b in at[number + 1 :] if part[a] != part[b]]


def neighbours(ways):
    beside = {}
    for one, other in ways:
        beside.setdefault(one, []).append(other)
        beside.setdefault(other, []).append(one)
    return beside


def file_of(image):
    return image.rsplit("/", 1)[-1]


def draft(kind, why, edits, places=(), images=(), pairs=()):
    return {"kind": kind, "why": why, "edits": edits, "places": sorted(places), "images": sorted(images),
            "pairs": sorted(sorted(pair) for pair in pairs)}


def pairs_of(truth, fits):
    places = sorted(truth.places)
    return [(a, b) for number, a in enumerate(places) for b in places[number + 1 :] if (a, b) not in truth.ways and fits(a, b)]


def words(truth, a, b):
    rooms = f"{truth.room(a) or 'several rooms'} and {truth.room(b) or 'several rooms'}"
    return f"{a} and {b}, {truth.apart_m(a, b):.1f} m apart, in {rooms}"


def half_near(truth, chance, pairs):
    near = [pair for pair in pairs if truth.apart_m(*pair) <= NEAR_M]
    return chance.choice(near if near and chance.random() < 0.5 else pairs)


def wrong_merge(truth, chance):
    pairs = pairs_of(truth, lambda a, b: truth.room(a) and truth.room(b) and truth.room(a) != truth.room(b) and truth.walled(a, b))
    a, b = half_near(truth, chance, pairs)
    images = [truth.image(member) for place in (a, b) for member in truth.places[place]]
    return draft("wrong merge", words(truth, a, b), [{"kind": "merge", "place": a, "into": b}], [a, b], images)


def false_way(truth, chance):
    def nowhere(a, b):
        return truth.walled(a, b) or (truth.apart_m(a, b) > FAR_M and not truth.in_sight(a, b))

    a, b = half_near(truth, chance, pairs_of(truth, nowhere))
    return draft("false way", words(truth, a, b), [{"kind": "add_edge", "from": a, "to": b}], pairs=[(a, b)])


def deleted_place(truth, chance):
    parting = {}
    for place in sorted(truth.places):
        pairs = truth.parted([way for way in truth.ways if place not in way], place)
        if set(map(tuple, pairs)) - set(truth.parted(truth.ways)):
            parting[place] = pairs
    place = chance.choice(sorted(parting))
    return draft("deleted place", f"{place} parts {len(parting[place])} pairs of destinations", [{"kind": "delete", "place": place}],
                 [place], [truth.image(member) for member in truth.places[place]], parting[place])


def deleted_way(truth, chance):
    parting = {}
    for way in sorted(truth.ways):
        if pairs := set(truth.parted(truth.ways - {way})) - set(truth.parted(truth.ways)):
            parting[way] = pairs
    way = chance.choice(sorted(parting))
    return draft("deleted way", f"{way} parts {len(parting[way])} pairs of destinations",
                 [{"kind": "remove_edge", "from": way[0], "to": way[1]}], pairs=parting[way])


def rename(truth, chance):
    place = chance.choice(sorted(truth.places))
    return draft("rename", place, [{"kind": "rename", "place": place, "label": "beside the window"}])


def right_merge(truth, chance):
    places = sorted(truth.places)
    pairs = [(a, b) for number, a in enumerate(places) for b in places[number + 1 :]
             if truth.apart_m(a, b) <= ONE_SPOT_M and truth.room(a) and truth.room(a) == truth.room(b) and truth.in_sight(a, b)]
    a, b = chance.choice(pairs)
    return draft("right merge", words(truth, a, b), [{"kind": "merge", "place": a, "into": b}])


def redundant_way(truth, chance):
    def redundant(way):
        left = truth.ways_m(way[0], truth.ways - {way})
        return left.get(way[1], math.inf) <= truth.apart_m(*way) + DETOUR_M

    way = chance.choice([way for way in sorted(truth.ways) if redundant(way)])
    return draft("redundant way", words(truth, *way), [{"kind": "remove_edge", "from": way[0], "to": way[1]}])


def true_way(truth, chance):
    a, b = chance.choice(pairs_of(truth, lambda a, b: truth.apart_m(a, b) <= 4.0 and truth.in_sight(a, b, BODY_M)))
    return draft("true way", words(truth, a, b), [{"kind": "add_edge", "from": a, "to": b}])


def split(truth, chance):
    """A place cut in two across its length."""
    sorted_along = {}
    for place, members in sorted(truth.places.items()):
        a, b = max(((a, b) for a in members for b in members), key=lambda pair: truth.between_m(*pair))
        if len(members) >= 4 and truth.between_m(a, b) >= 0.8:
            sorted_along[place] = sorted(members, key=lambda member: truth.between_m(a, member))
    place = chance.choice(sorted(sorted_along))
    half = sorted_along[place][len(sorted_along[place]) // 2 :]
    return draft("split", f"{place}, {len(half)} of {len(sorted_along[place])} pictures",
                 [{"kind": "split", "place": place, "images": [truth.image(member) for member in half]}])


def move(truth, chance):
    """A picture nearer to another place of its room than to its own."""
    found = []
    for place, members in sorted(truth.places.items()):
        for member in members if len(members) > 1 else ():
            for other in sorted(truth.places):
                away_m = truth.between_m(member, truth.prototype[other])
                own_m = truth.between_m(member, truth.prototype[place])
                if other != place and away_m <= min(BESIDE_M, own_m) and truth.room(other) == truth.room_of[member] != "":
                    found.append((member, place, other))
    member, place, other = chance.choice(found)
    return draft("move", f"{member} of {place} to {other}", [{"kind": "move", "images": [truth.image(member)], "into": other}])


def new_destination(truth, chance):
    taken = {file_of(one["image"]) for one in truth.destinations}
    file = chance.choice(sorted(set(truth.pose) - taken))
    return draft("new destination", file, [{"kind": "add_destination", "image": truth.image(file), "label": "beside the window"}])


def destination(truth, chance):
    one = chance.choice(truth.destinations)
    edit = chance.choice([{"kind": "remove_destination"}, {"kind": "name_destination", "label": "the old chair"},
                          {"kind": "set_pictogram", "pictogram": "seat"}])
    return draft("destination", f"{edit['kind']}, {one['label']}", [{**edit, "destination": one["id"]}])


def reject_wrong(truth, chance):
    def wrong(one):
        files = [file_of(one[end]) for end in ("prototype_a", "prototype_b")]
        return one["decision"] != "accepted" and truth.between_m(*files) > 3.0

    one = chance.choice([one for one in truth.hypotheses if wrong(one)])
    ends = {end: one[end] for end in ("prototype_a", "prototype_b")}
    return draft("reject wrong", str(ends), [{"kind": "decide", **ends, "accept": False}])


SORTS = {
    "harmful": [wrong_merge, deleted_place, false_way, wrong_merge, deleted_way, false_way],
    "harmless": [rename, right_merge, redundant_way, true_way, split, move, new_destination, destination, reject_wrong],
}


def draw(truth, sort, count, seed):
    """So many drafts of a sort, no two alike; its kinds by turns from a random one on, those that the map has none of left out."""
    chance = random.Random(seed)
    kinds = SORTS[sort]
    first = chance.randrange(len(kinds))
    drawn = []
    for turn in range(20 * count):
        if len(drawn) == count:
            break
        try:
            one = kinds[(first + turn) % len(kinds)](truth, chance)
        except IndexError:  # nothing to choose from
            continue
        if one["edits"] not in [other["edits"] for other in drawn]:
            drawn.append(one)
    return drawn


def is_spot(draft, worse):
    """Whether what the check tells is what the draft harms."""
    if worse["kind"] in ("way", "far_way", "route"):
        return sorted((worse["place"], worse["other"])) in draft["pairs"]
    return worse["place"] in draft["places"] or bool(set(worse["images"]) & set(draft["images"]))
