# SPDX-License-Identifier: Apache-2.0
"""Edits of all kinds, chosen by seed from what a map's graph has at the moment."""

FEWEST_PLACES = 8  # of what is left after merging and deleting
MOST_DESTINATIONS = 12
PICTOGRAMS = ("", "bath", "bed", "desk", "door", "kitchen", "lift", "seat")
TRIES = 20


class RandomEdits:
    def __init__(self, random):
        self.random = random
        self.named = 0

    def batch(self, graph):
        """One edit, or several of places that have nothing to do with each other."""
        wanted = 1 if self.random.random() < 0.6 else self.random.randint(2, 5)
        edits, used = [], set()
        for _ in range(TRIES):
            if len(edits) == wanted:
                break
            made = self.random.choice(MAKERS)(self, graph)
            if made and not used & made[1]:
                edits.append(made[0])
                used |= made[1]
        return edits

    def label(self):
        self.named += 1
        return f"name {self.named}"

    def place(self, graph, members=1):
        found = [one for one in graph["places"] if len(one["members"]) >= members]
        return self.random.choice(found) if found else None

    def some_of(self, place):
        others = [image for image in place["members"] if image != place["prototype"]]
        return sorted(self.random.sample(others, self.random.randint(1, len(others))))

    def rename(self, graph):
        place = self.place(graph)
        return {"kind": "rename", "place": place["id"], "label": self.label()}, {place["id"]}

    def merge(self, graph):
        if len(graph["places"]) <= FEWEST_PLACES:
            return None
        a, b = self.random.sample(graph["places"], 2)
        return {"kind": "merge", "place": a["id"], "into": b["id"]}, {a["id"], b["id"]}

    def split(self, graph):
        place = self.place(graph, 2)
        return place and ({"kind": "split", "place": place["id"], "images": self.some_of(place)}, {place["id"]})

    def move(self, graph):
        place, other = self.place(graph, 2), self.place(graph)
        if not place or place["id"] == other["id"]:
            return None
        return {"kind": "move", "images": self.some_of(place)[:2], "into": other["id"]}, {place["id"], other["id"]}

    def delete(self, graph):
        if len(graph["places"]) <= FEWEST_PLACES:
            return None
        place = self.place(graph)
        return {"kind": "delete", "place": place["id"]}, {place["id"]}

    def add_edge(self, graph):
        a, b = self.random.sample(graph["places"], 2)
        return {"kind": "add_edge", "from": a["id"], "to": b["id"]}, {a["id"], b["id"]}

    def edge(self, graph):
        return self.random.choice(graph["edges"]) if graph["edges"] else None

    def remove_edge(self, graph):
        edge = self.edge(graph)
        return edge and ({"kind": "remove_edge", "from": edge["from"], "to": edge["to"]}, {edge["from"], edge["to"]})

    def block_edge(self, graph):
        edge = self.edge(graph)
        return edge and ({"kind": "block_edge", "from": edge["from"], "to": edge["to"], "blocked": not edge["blocked"]},
                         {edge["from"], edge["to"]})

    def decide(self, graph):
        if not graph["hypotheses"]:
            return None
        one = self.random.choice(graph["hypotheses"])
        return ({"kind": "decide", "prototype_a": one["prototype_a"], "prototype_b": one["prototype_b"],
                 "accept": one["decision"] != "accepted"},
                {place["id"] for place in graph["places"] if {one["prototype_a"], one["prototype_b"]} & set(place["members"])})

    def add_destination(self, graph):
        if len(graph["destinations"]) >= MOST_DESTINATIONS:
            return None
        place = self.place(graph)
        return ({"kind": "add_destination", "image": self.random.choice(place["members"]), "label": self.label()},
                {place["id"]})

    def destination(self, graph):
        return self.random.choice(graph["destinations"]) if graph["destinations"] else None

    def remove_destination(self, graph):
        one = self.destination(graph)
        return one and ({"kind": "remove_destination", "destination": one["id"]}, {one["place"]})

    def name_destination(self, graph):
        one = self.destination(graph)
        return one and ({"kind": "name_destination", "destination": one["id"], "label": self.label()}, {one["place"]})

    def set_pictogram(self, graph):
        one = self.destination(graph)
        return one and ({"kind": "set_pictogram", "destination": one["id"], "pictogram": self.random.choice(PICTOGRAMS)},
                        {one["place"]})

    def set_destination_picture(self, graph):
        one = self.destination(graph)
        place = self.place(graph)
        return one and ({"kind": "set_destination_picture", "destination": one["id"],
                         "image": self.random.choice(place["members"])}, {one["place"], place["id"]})


MAKERS = (RandomEdits.rename, RandomEdits.merge, RandomEdits.split, RandomEdits.move, RandomEdits.delete,
          RandomEdits.add_edge, RandomEdits.remove_edge, RandomEdits.block_edge, RandomEdits.decide,
          RandomEdits.add_destination, RandomEdits.remove_destination, RandomEdits.name_destination,
          RandomEdits.set_pictogram, RandomEdits.set_destination_picture)
