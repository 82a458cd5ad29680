# SPDX-License-Identifier: Apache-2.0
"""Two parts of run.py: what the bytes of an appearance are worth, by the program homeward_bench_budget.

`codes`: descriptors and columns as floating point numbers and as the bytes that are stored. `budget`: how many features
are kept. Both on a house that the program generates, found again by night, and on the developers' pictures where these
are there. A place counts as found when the picture that most verified matches speak for was taken within 1 m of the
query (`budget`: of the twenty pictures with the most matches); queries without any picture so near are left out.
"""

import csv
import decimal
import statistics
import subprocess

from confidence import HOUSE, draw_pairs

SIFT = (75, 150, 300, 450, 600, 900)
COLUMNS = (0, 75, 150)
IN_USE = (600, 150)
NEAR_M = 1.0


def generated_house(bench):
    """A tour by day to find places in, and one by night, the other way round and with steps of another length."""
    day, night = bench.scratch / "house_day", bench.scratch / "house_night"
    if not day.exists():
        bench.program("simulate", "tour", "--world", "house:1", "--rooms", ",".join(HOUSE), "--step-m", 0.8, "--out", day)
        bench.program("simulate", "tour", "--world", "house:1", "--light", "night", "--seed", 2, "--rooms", ",".join(reversed(HOUSE)),
                      "--step-m", 1.1, "--out", night)
        draw_pairs(day)
    return day, night


def sets_of(bench, skipped):
    """Every set of pictures that is there: its name, and what the program is to be given, run by run."""
    day, night = generated_house(bench)
    house = ["--camera", day / "camera.json"]
    sets = [("generated house", [house + ["--pairs", day / "pairs.csv", "--poses", day / "poses.csv", "--same-m", 8,
                                          "--gallery", day, "--queries", night]])]
    train = bench.data / "sim" / "home" / "train"
    if train.is_dir():
        camera = ["--camera", train / "camera.json"]
        places = ["--gallery", train, "--every-place", 3, "--queries"]
        sets.append(("rendered house", [camera + ["--pairs", train / "pairs.csv", "--poses", train / "poses.csv"]]))
        sets.append(("rendered house by day", [camera + places + [train.parent / "test_day", "--every-query", 2]]))
        sets.append(("rendered house by night", [camera + places + [train.parent / "test_night"]]))
    else:
        skipped(f"{train} is not there")
    for title, name in (("hand-held corridor", "sait_corridor_360"), ("corridors alike", "plm_corridor_360")):
        folder = bench.data / "real" / name
        if folder.is_dir():
            sets.append((title, [["--camera", folder / "camera.json", "--pairs", folder / "pairs.csv"]]))
        else:
            skipped(f"{folder} is not there")
    return sets


def measured(bench, command, arguments):
    program = bench.homeward.parent / "homeward_bench_budget"
    if not program.is_file():
        raise RuntimeError(f"{program} is not there; build the target homeward_bench_budget")
    done = subprocess.run([program, command, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"homeward_bench_budget: {done.stderr.strip()}")
    return list(csv.DictReader(done.stdout.splitlines()))


def number(text):
    return float(text) if text else None


def share(hits):
    hits = list(hits)
    return sum(hits) / len(hits) if hits else None


def bearings(rows, low_m=0.0, high_m=1e9):
    """Figures of home vectors between pictures of some distance; where no distance is known it is 0."""
    rows = [row for row in rows if row["measure"] == "bearing" and low_m <= float(row["distance_m"]) < high_m]
    errors = [number(row["answer"]) for row in rows]
    answered = sorted(error for error in errors if error is not None)
    right = [(float(row["right"]), float(row["matches"])) for row in rows if row["right"]]
    return {
        "answered": share(error is not None for error in errors),
        "median_deg": statistics.median(answered) if answered else None,
        "p95_deg": answered[min(len(answered) - 1, int(0.95 * len(answered)))] if answered else None,
        "below_15": share(error is not None and error < 15 for error in errors),
        "answered_below_30": share(error < 30 for error in answered),
        "right_matches": statistics.mean(n for n, _ in right) if right else None,
        "right_share": sum(n for n, _ in right) / max(1.0, sum(n for _, n in right)) if right else None,
    }


def found(rows):
    places = [row for row in rows if row["measure"] == "place" and float(row["distance_m"]) <= NEAR_M]
    return share(float(row["answer"]) <= NEAR_M for row in places)


def by_variant(rows):
    variants = {}
    for row in rows:
        variants.setdefault((int(row["sift"]), int(row["columns"]), row["code"]), []).append(row)
    return variants


# Title of a column, the set it is about, decimals, and the figure.
CODE_FIGURES = (
    ("generated house: right matches of a pair", "generated house", 1, lambda rows: bearings(rows)["right_matches"]),
    ("generated house: right, of all matches", "generated house", 3, lambda rows: bearings(rows)["right_share"]),
    ("generated house: median error, degrees", "generated house", 2, lambda rows: bearings(rows)["median_deg"]),
    ("generated house: below 15 degrees", "generated house", 3, lambda rows: bearings(rows)["below_15"]),
    ("generated house: place by night", "generated house", 3, found),
    ("rendered house: right matches of a pair", "rendered house", 1, lambda rows: bearings(rows)["right_matches"]),
    ("rendered house: right, of all matches", "rendered house", 3, lambda rows: bearings(rows)["right_share"]),
    ("rendered house: median error, degrees", "rendered house", 2, lambda rows: bearings(rows)["median_deg"]),
    ("rendered house: below 15 degrees", "rendered house", 3, lambda rows: bearings(rows)["below_15"]),
    ("rendered house: place by day", "rendered house by day", 3, found),
    ("rendered house: place by night", "rendered house by night", 3, found),
    ("hand-held corridor: right matches of a pair", "hand-held corridor", 1, lambda rows: bearings(rows)["right_matches"]),
    ("hand-held corridor: right, of all matches", "hand-held corridor", 3, lambda rows: bearings(rows)["right_share"]),
    ("hand-held corridor: median error, degrees", "hand-held corridor", 2, lambda rows: bearings(rows)["median_deg"]),
    ("hand-held corridor: below 15 degrees", "hand-held corridor", 3, lambda rows: bearings(rows)["below_15"]),
    ("corridors alike: answered", "corridors alike", 2, lambda rows: bearings(rows)["answered"]),
    ("corridors alike: of these below 30 degrees", "corridors alike", 2, lambda rows: bearings(rows)["answered_below_30"]),
)
BUDGET_FIGURES = (
    ("generated house: place by night", "generated house", 3, found),
    ("median error, degrees", "generated house", 2, lambda rows: bearings(rows)["median_deg"]),
    ("2 to 4 m below 15", "generated house", 3, lambda rows: bearings(rows, 2, 4)["below_15"]),
    ("4 to 8 m", "generated house", 3, lambda rows: bearings(rows, 4, 8)["below_15"]),
    ("rendered house: place by day", "rendered house by day", 3, found),
    ("by night", "rendered house by night", 3, found),
    ("median error, degrees", "rendered house", 2, lambda rows: bearings(rows)["median_deg"]),
    ("2 to 4 m below 15", "rendered house", 3, lambda rows: bearings(rows, 2, 4)["below_15"]),
    ("4 to 8 m", "rendered house", 3, lambda rows: bearings(rows, 4, 8)["below_15"]),
    ("hand-held corridor: median error, degrees", "hand-held corridor", 2, lambda rows: bearings(rows)["median_deg"]),
    ("below 15", "hand-held corridor", 3, lambda rows: bearings(rows)["below_15"]),
    ("corridors alike: answered", "corridors alike", 2, lambda rows: bearings(rows)["answered"]),
    ("of these below 30", "corridors alike", 2, lambda rows: bearings(rows)["answered_below_30"]),
)


def tabulate(bench, part, command, arguments, figures):
    """For each variant in the order in which the program measures them: what it is, and its figures."""
    results = {}
    for name, runs in sets_of(bench, lambda reason: bench.skip(part, reason)):
        results[name] = by_variant(row for run in runs for row in measured(bench, command, run + arguments))
    used = [figure for figure in figures if figure[1] in results]
    rows = []
    for variant in results["generated house"]:
        sizes = [float(row["bytes"]) for of_set in results.values() for row in of_set[variant]]
        cells = [round(statistics.mean(sizes))]
        for _, name, decimals, figure in used:
            value = figure(results[name][variant])
            cells.append(None if value is None else decimal.Decimal(f"{value:.{decimals}f}"))
        rows.append((variant, cells))
    return ["bytes"] + [title for title, *_ in used], rows


def codes(bench):
    titles, rows = tabulate(bench, "codes", "codes", ["--sift", IN_USE[0], "--columns", IN_USE[1]], CODE_FIGURES)
    header = [""]
    for (sift, columns, code), _ in rows:
        kinds = zip((sift, columns), ("SIFT", "columns"), code.split("/"))
        header.append("; ".join(f"{count} {kind}, {kept}" for count, kind, kept in kinds if count > 0))
    bench.table("What bytes cost", header, [[title, *(cells[i] for _, cells in rows)] for i, title in enumerate(titles)])


def budget(bench):
    lists = ["--shortlist", 20, "--sift", ",".join(map(str, SIFT)), "--columns", ",".join(map(str, COLUMNS))]
    titles, rows = tabulate(bench, "budget", "curve", lists, BUDGET_FIGURES)
    bench.table("What features are worth", ["SIFT", "columns", *titles], [[sift, columns, *cells] for (sift, columns, _), cells in rows])
