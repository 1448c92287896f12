"""Computes the main tables of the report again, with scipy, and compares them with expected.csv.

    python3 analysis.py          in this folder

Reads answers.csv (one row an answer), anchors.csv where there are any, and expected.csv (one row a number of the report);
codebook.csv explains them.
Left out: claims, linear, logistic and ordinal mixed models (analysis.R has them), d', ANOVA, Friedman and Cochran tests, effect
sizes, agreement, R squared, Bayes factors, intervals over trials, speed, order effects, groups, signals, times. The mixed models
of statsmodels have no crossed groups with Satterthwaite's degrees of freedom.
"""
import csv
import math
import os
import sys
import warnings
from collections import defaultdict

try:
    from scipy import stats
except ImportError:
    sys.exit("analysis.py needs scipy: apt-get install python3-scipy")

warnings.filterwarnings("ignore")


def rows_of(name):
    with open(name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


values = defaultdict(list)  # [question, condition]: every answer
cells = defaultdict(lambda: defaultdict(list))  # [question, condition, participant][fabric]: number, repetition, instruction
for row in rows_of("answers.csv"):
    text = row["correct"] or row["rating"]
    if text:
        values[row["question"], row["condition"]].append(float(text))
        answer = float(text), row["repetition"], row["instruction"]
        cells[row["question"], row["condition"], row["participant"]][row["fabric"]].append(answer)
participants = sorted({participant for _, _, participant in cells})


def mean(numbers):
    return math.fsum(numbers) / len(numbers) if numbers else math.nan


def sd(numbers):
    centre = mean(numbers)
    return math.sqrt(math.fsum((x - centre) ** 2 for x in numbers) / (len(numbers) - 1)) if len(numbers) > 1 else math.nan


def numbers_of(answers):
    return [number for number, _, _ in answers]


most = defaultdict(int)  # answers of a full cell, by question
for (of_question, _, _), of_fabrics in cells.items():
    most[of_question] = max(most[of_question], *map(len, of_fabrics.values()))


def are_shared(question, a, b, mark, have_met):
    """Whether two conditions share such marks: they meet, and full cells of one participant and fabric have the same."""
    for p in participants:
        first, second = (cells.get((question, condition, p), {}) for condition in (a, b))
        for fabric in first.keys() & second.keys():
            own, others = (sorted(map(mark, of_cell[fabric])) for of_cell in (first, second))
            if len(own) == len(others) == most[question] and own != others:
                return False
            have_met = have_met or not set(own).isdisjoint(others)
    return have_met


marks = {}


def mark_of(question, a, b):
    """What matches the answers of two conditions where cells have several: the name of the repetition, else the instruction, else
    nothing. Names may be mere row numbers, or those of sessions that belong to one condition."""
    key = question, *sorted((a, b))
    if key not in marks:
        by_name, by_instruction = (lambda answer: answer[1:]), (lambda answer: answer[2])
        marks[key] = (lambda answer: "") if most[question] < 2 else \
            by_name if are_shared(question, a, b, by_name, False) else \
            by_instruction if are_shared(question, a, b, by_instruction, True) else (lambda answer: "")
    return marks[key]


def common_mean(own, others, mark):
    """Mean of a cell's answers whose marks the other condition has, too. Marks with unequally many answers count equally."""
    shared = {mark(answer) for answer in own} & {mark(answer) for answer in others}
    own, others = ([answer for answer in answers if mark(answer) in shared] for answers in (own, others))
    if sorted(map(mark, own)) == sorted(map(mark, others)):
        return mean(numbers_of(own))
    return mean([mean(numbers_of([answer for answer in own if mark(answer) == one])) for one in shared])


def means_of(question, condition, other=None):
    """Mean of each participant who answered, over fabrics; repetitions of a fabric are averaged first. With another condition:
    over the fabrics, and repetitions, that the participant answered under both."""
    means = {}
    for p in participants:
        fabrics = cells.get((question, condition, p), {})
        if other is None:
            own = [mean(numbers_of(answers)) for answers in fabrics.values()]
        else:
            mark, common = mark_of(question, condition, other), cells.get((question, other, p), {})
            own = [common_mean(answers, common[fabric], mark) for fabric, answers in fabrics.items() if fabric in common]
        own = [number for number in own if not math.isnan(number)]
        if own:
            means[p] = mean(own)
    return means


def are_equal(numbers):
    """No t test can use such numbers. Means of equal numbers may differ in the last digit."""
    return len(numbers) < 2 or max(numbers) - min(numbers) <= 1e-14 * max(abs(x) for x in numbers)


def t_test(numbers, mu=0.0, alternative="two-sided"):
    return math.nan if are_equal(numbers) else stats.ttest_1samp(numbers, mu, alternative=alternative).pvalue


def interval(numbers, confidence):
    if are_equal(numbers):
        return math.nan, math.nan
    half = stats.t.ppf((1 + confidence) / 2, len(numbers) - 1) * sd(numbers) / math.sqrt(len(numbers))
    return mean(numbers) - half, mean(numbers) + half


def matches(question, condition, chance):
    own = values[question, condition]
    numbers = {"correct": sum(own), "trials": len(own), "proportion": mean(own)}
    if chance is None or not own:
        return numbers
    numbers["p_chance"] = stats.binomtest(int(sum(own)), len(own), chance, alternative="greater").pvalue
    numbers["p_chance_participants"] = t_test(list(means_of(question, condition).values()), chance)
    return numbers


def ratings(question, condition):
    own = values[question, condition]
    means = list(means_of(question, condition).values())
    low, high = interval(means, 0.95)
    return {"n": len(own), "mean": mean(own), "sd": sd(own), "ci95_low": low, "ci95_high": high}


def differences(question, a, b):
    first, second = means_of(question, a, b), means_of(question, b, a)
    return [first[p] - second[p] for p in participants if p in first and p in second]


def comparison(question, a, b):
    d = differences(question, a, b)
    result = {"n": len(d), "mean_difference": mean(d)}
    if are_equal(d):
        return result
    low, high = interval(d, 0.95)
    result.update(statistic=mean(d) / (sd(d) / math.sqrt(len(d))), df=len(d) - 1, p=t_test(d), ci95_low=low, ci95_high=high,
                  d_z=mean(d) / sd(d))
    return result


def equivalence(question, a, b, low, high):
    """Two one-sided t tests; the interval of 90 % holds what they do not reject."""
    d = differences(question, a, b)
    left, right = interval(d, 0.9)
    return {"n": len(d), "mean_difference": mean(d), "p_lower": t_test(d, low, "greater"), "p_upper": t_test(d, high, "less"),
            "ci90_low": left, "ci90_high": right}


def intraclass(pairs):
    """ICC(2,1) of two answers each; none of a single pair, or where the pairs do not differ."""
    n = len(pairs)
    if n < 2 or are_equal([x for pair in pairs for x in pair]):
        return math.nan
    centre = mean([x for pair in pairs for x in pair])
    rows, columns = [mean(pair) for pair in pairs], [mean([pair[k] for pair in pairs]) for k in (0, 1)]
    targets = 2 * math.fsum((x - centre) ** 2 for x in rows) / (n - 1)
    occasions = n * math.fsum((x - centre) ** 2 for x in columns)
    error = math.fsum((pair[k] - row - columns[k] + centre) ** 2 for pair, row in zip(pairs, rows) for k in (0, 1)) / (n - 1)
    below = targets + error + 2 * (occasions - error) / n
    return (targets - error) / below if below > 1e-12 * (targets + error) else math.nan


def at_least_0(number):
    return number if math.isnan(number) else max(0.0, number)


def within_sd(pairs):
    return math.sqrt(mean([(second - first) ** 2 for first, second in pairs]) / 2)


def jackknife(own, statistic, there, back):
    """Interval over participants, each left out once."""
    n = len(own)
    try:
        whole = there(statistic([pair for pairs in own for pair in pairs]))
        pseudo = [n * whole - (n - 1) * there(statistic([pair for k, pairs in enumerate(own) if k != i for pair in pairs]))
                  for i in range(n)]
        half = stats.t.ppf(0.975, n - 1) * sd(pseudo) / math.sqrt(n) if n > 2 else math.nan
        return back(whole - half), back(whole + half)
    except (ValueError, ZeroDivisionError):
        return math.nan, math.nan


def unless_point(ends):
    """All participants show the same: an interval of one point would claim that the value is known exactly."""
    return ends if ends[1] - ends[0] > 1e-9 else (math.nan, math.nan)


def twice(question):
    own = defaultdict(list)
    for row in anchors:
        if row["question"] == question and row["kind"] == "repeated":
            own[row["participant"]].append((row["first"], row["second"]))
    return list(own.values())


def anchor_floor(question):
    own = defaultdict(list)
    for row in anchors:
        if row["question"] == question and row["kind"] == "mismatched":
            own[row["participant"]].append(float(row["first"]))
    every = [x for numbers in own.values() for x in numbers]
    means = [mean(numbers) for numbers in own.values()]
    low, high = interval(means, 0.95)
    return {"n": len(every), "mean": mean(every), "sd": sd(every), "ci95_low": low, "ci95_high": high}


def anchor_ratings(question, top):
    own = [[(float(first), float(second)) for first, second in pairs] for pairs in twice(question)]
    pairs = [pair for of_one in own for pair in of_one]
    icc, noise = intraclass(pairs), within_sd(pairs)
    shifts = [mean([second - first for first, second in of_one]) for of_one in own]
    result = {"pairs": len(pairs), "icc": icc, "within_sd": noise, "mean_difference": mean(shifts),
              "ceiling_of_correlation": math.sqrt(at_least_0(icc)), "ceiling_of_mean": top - noise / math.sqrt(2 * math.pi)}
    result["icc_ci95_low"], result["icc_ci95_high"] = unless_point(jackknife(own, intraclass, math.atanh, math.tanh))
    result["within_sd_ci95_low"], result["within_sd_ci95_high"] = unless_point(jackknife(own, within_sd, math.log, math.exp))
    result["ci95_low"], result["ci95_high"] = interval(shifts, 0.95)
    return result


def share_of_pairs(own):
    """Share of pairs that agree, each by a score of 0 to 1, with Wilson's interval and the design effect of participants."""
    n = sum(len(scores) for scores in own)
    if n == 0:
        return math.nan, math.nan, math.nan
    share = math.fsum(score for scores in own for score in scores) / n
    independent = n * share * (1 - share)
    squares = math.fsum((math.fsum(scores) - share * len(scores)) ** 2 for scores in own)
    effect = max(1.0, squares * len(own) / (len(own) - 1) / independent) if len(own) > 1 and independent > 0 else 1.0
    z, size = stats.norm.ppf(0.975), n / effect
    middle = (share + z * z / (2 * size)) / (1 + z * z / size)
    half = z * math.sqrt(share * (1 - share) / size + z * z / (4 * size * size)) / (1 + z * z / size)
    return share, max(0.0, middle - half), min(1.0, middle + half)


def anchor_choices(question, m, k):
    """Of m alternatives; k answers are compared: 2 where only right and wrong are, and two wrong ones agree by 1/(m - 1)."""
    own = twice(question)
    share, low, high = share_of_pairs([[float(first == second) for first, second in pairs] for pairs in own])
    two_wrong = 1 / (m - 1) if k < m else 1.0
    blind = share_of_pairs([[(two_wrong if first == "wrong" else 1.0) if first == second else 0.0 for first, second in pairs]
                            for pairs in own])
    kappa, kappa_low, kappa_high = ((m * value - 1) / (m - 1) for value in blind)
    return {"pairs": sum(map(len, own)), "agreement": share, "agreement_ci95_low": low, "agreement_ci95_high": high,
            "kappa": kappa, "kappa_ci95_low": kappa_low, "kappa_ci95_high": kappa_high,
            "ceiling_of_proportion": (1 + math.sqrt((k - 1) * at_least_0(k * share - 1))) / k}


def kappa_of_words(own):
    """Of participants with two pairs and more: by chance the first word of one pair is the second word of another."""
    pairs = agreeing = by_chance = 0.0
    for of_one in own:
        n, same = len(of_one), sum(first == second for first, second in of_one)
        crossed = sum(first == second for first, _ in of_one for _, second in of_one)
        pairs, agreeing, by_chance = pairs + n, agreeing + same, by_chance + (crossed - same) / (n - 1)
    return (agreeing - by_chance) / (pairs - by_chance) if by_chance < pairs else math.nan


def anchor_words(question):
    own = twice(question)
    share, low, high = share_of_pairs([[float(first == second) for first, second in pairs] for pairs in own])
    enough = [pairs for pairs in own if len(pairs) > 1]
    kappa = kappa_of_words(enough)
    ends = unless_point(jackknife([[pairs] for pairs in enough], kappa_of_words, math.atanh, math.tanh))
    return {"pairs": sum(map(len, own)), "agreement": share, "agreement_ci95_low": low, "agreement_ci95_high": high,
            "kappa": kappa, "kappa_ci95_low": ends[0], "kappa_ci95_high": ends[1],
            "ceiling_of_proportion": (1 + math.sqrt(at_least_0(kappa))) / 2}


def holm(found):
    """Adds Holm's correction over all comparisons of a question."""
    questions = {key[1] for key in found}
    for question in questions:
        own = sorted((numbers for key, numbers in found.items() if key[:2] == ("comparison", question) and "p" in numbers),
                     key=lambda numbers: numbers["p"])
        largest = 0.0
        for rank, numbers in enumerate(own):
            largest = max(largest, min(1.0, (len(own) - rank) * numbers["p"]))
            numbers["p_holm"] = largest


def key_of(row):
    return row["section"], row["question"], row["a"], row["b"]


anchors = rows_of("anchors.csv") if os.path.exists("anchors.csv") else []
expected = rows_of("expected.csv")
if not expected:
    print("the report has no numbers of choices or ratings: there is nothing to compute\nreproduced: 0 of 0")
    sys.exit(0)
compute = {"matches": lambda r: matches(r["question"], r["a"], float(r["low"]) if r["low"] else None),
           "ratings": lambda r: ratings(r["question"], r["a"]),
           "comparison": lambda r: comparison(r["question"], r["a"], r["b"]),
           "equivalence": lambda r: equivalence(r["question"], r["a"], r["b"], float(r["low"]), float(r["high"])),
           "anchor_floor": lambda r: anchor_floor(r["question"]),
           "anchor_ratings": lambda r: anchor_ratings(r["question"], float(r["high"])),
           "anchor_choices": lambda r: anchor_choices(r["question"], float(r["low"]), float(r["high"])),
           "anchor_words": lambda r: anchor_words(r["question"])}
left_out = [row for row in expected if row["section"] not in compute]
expected = [row for row in expected if row["section"] in compute]
found = {}
for row in expected:
    if key_of(row) not in found:
        found[key_of(row)] = compute[row["section"]](row)
holm(found)


def is_same(row):
    value = found[key_of(row)].get(row["quantity"], math.nan)
    if not row["value"]:
        return not math.isfinite(value)
    reported = float(row["value"])
    return math.isfinite(value) and abs(value - reported) <= 1e-9 + 1e-7 * abs(reported)


same = [is_same(row) for row in expected]
for section in dict.fromkeys(row["section"] for row in expected):
    own = [ok for row, ok in zip(expected, same) if row["section"] == section]
    print(f"{section}: {sum(own)} of {len(own)}")
for row in [row for row, ok in zip(expected, same) if not ok][:20]:
    value = found[key_of(row)].get(row["quantity"], math.nan)
    print("differs:", *key_of(row), row["quantity"] + ": report", row["value"] or "none", "here", repr(value))
for section in dict.fromkeys(row["section"] for row in left_out):
    print(f"left out: {section}: analysis.R computes it")
print("left out: d', ANOVA, Friedman and Cochran tests, effect sizes, agreement, R squared, Bayes factors, intervals over trials")
print("left out: speed, order effects, groups, signals, times")
print(f"reproduced: {sum(same)} of {len(same)}")
sys.exit(0 if all(same) else 1)
