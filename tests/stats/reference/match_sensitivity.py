# python3 tests/stats/reference/match_sensitivity.py: numbers of tests/stats/match_sensitivity_test.cpp, by its standard library alone.
import math
from statistics import NormalDist

z = NormalDist().inv_cdf


def indices(answers):
    """d' and c of (participant, fabric, was same, said same)."""
    same = [said for _, _, was, said in answers if was]
    different = [said for _, _, was, said in answers if not was]
    hit, false_alarm = z((sum(same) + .5) / (len(same) + 1)), z((sum(different) + .5) / (len(different) + 1))
    return hit - false_alarm, -(hit + false_alarm) / 2


def jackknife(answers, cluster, which):
    clusters = sorted({cluster(one) for one in answers})
    left = [indices([one for one in answers if cluster(one) != out])[which] for out in clusters]
    mean = sum(left) / len(left)
    return (len(left) - 1) / len(left) * sum((value - mean) ** 2 for value in left)


def variance_of_z(said, pairs):
    rate = (said + .5) / (pairs + 1)
    return rate * (1 - rate) / (pairs + 1) / NormalDist().pdf(z(rate)) ** 2


counted = [(0, 0, True, i < 40) for i in range(50)] + [(0, 0, False, i < 15) for i in range(50)]
print('40 of 50 and 15 of 50: %.15g %.15g' % indices(counted))

said = ['sdsd', 'sssd', 'dsds', 'sdsd', 'sdss', 'dssd']
answers = [(p, f, (p + f) % 2 == 0, said[p][f] == 's') for p in range(6) for f in range(4)]
for which, name in enumerate(('d', 'c')):
    estimate = indices(answers)[which]
    people = jackknife(answers, lambda one: one[0], which)
    fabrics = jackknife(answers, lambda one: one[1], which)
    cells = jackknife(answers, lambda one: one[:2], which)
    both = max(people, fabrics, people + fabrics - cells)
    t5, t3 = 2.5705818356363146, 3.182446305283709  # R: qt(.975, 5), qt(.975, 3)
    reaches = t5 * math.sqrt(people), t3 * math.sqrt(both)
    print(name, '%.15g' % estimate, *('[%.15g, %.15g]' % (estimate - reach, estimate + reach) for reach in reaches))
hits, false_alarms = (sum(one[3] for one in answers if one[2] == was) for was in (True, False))
print('se %.15g' % math.sqrt(variance_of_z(hits, 12) + variance_of_z(false_alarms, 12)))
