"""The numbers frozen in random_test.cpp, from the published algorithms alone: xoshiro256** (Blackman & Vigna 2018),
splitmix64 (Steele, Lea & Flood 2014), FNV-1a and Fisher-Yates. Run: python3 random_reference.py"""

MASK = (1 << 64) - 1


def rotated(x, bits):
    return ((x << bits) | (x >> (64 - bits))) & MASK


def splitmix64(state):
    state = (state + 0x9E3779B97F4A7C15) & MASK
    z = state
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
    return state, z ^ (z >> 31)


class Random:
    def __init__(self, seed):
        self.s = []
        for _ in range(4):
            seed, word = splitmix64(seed)
            self.s.append(word)

    def next(self):
        s = self.s
        result = (rotated((s[1] * 5) & MASK, 7) * 9) & MASK
        t = (s[1] << 17) & MASK
        s[2] ^= s[0]
        s[3] ^= s[1]
        s[1] ^= s[2]
        s[0] ^= s[3]
        s[2] ^= t
        s[3] = rotated(s[3], 45)
        return result

    def below(self, bound):
        threshold = (1 << 64) % bound
        while True:
            value = self.next()
            if value >= threshold:
                return value % bound


def stream(seed, purpose):
    fnv = 0xCBF29CE484222325
    for byte in purpose.encode():
        fnv = ((fnv ^ byte) * 0x100000001B3) & MASK
    mixed = splitmix64(seed)[1]
    return Random(splitmix64(mixed ^ rotated(fnv, 23))[1])


example = Random(0)
example.s = [1, 2, 3, 4]
assert [example.next() for _ in range(4)] == [11520, 0, 1509978240, 1215971899390074240]  # as published

r = Random(42)
print("first four of seed 42:", [hex(r.next()) for _ in range(4)])
r = Random(42)
checksum = 0
for i in range(1000):
    checksum = (checksum * 31 + r.below(1 + i)) & MASK
print("checksum of bounded draws:", hex(checksum))
r = stream(7, "photo/F03/17")
print("stream:", [hex(r.next()) for _ in range(2)])
r = Random(5)
cards = list(range(10))
for i in range(10, 1, -1):
    j = r.below(i)
    cards[i - 1], cards[j] = cards[j], cards[i - 1]
print("shuffle:", cards)
