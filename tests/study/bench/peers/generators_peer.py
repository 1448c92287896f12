"""The networks of vis2hap-nn (rendering/models/networks) in PyTorch, for `vis2hap bench generators --peers`.

Arguments: FOLDER BASE-CHANNELS ROWS FRAMES RINGS MEAN-SCALE. FOLDER/peer.safetensors holds the parameters, one batch and the
program's own answers to it. The first line printed is "ready VERSION LARGEST-DIFFERENCE"; then each line of standard
input is answered by a line: "train" and "infer" by milliseconds, "losses" by the losses of the last training step.
"""
import json
import os
import sys
import time

import torch
from torch import nn
from torch.nn import functional as F

folder, sizes = sys.argv[1], sys.argv[2:]
c, rows, frames, rings = (int(size) for size in sizes[:4])
mean_scale = float(sizes[4])
torch.set_num_threads(os.cpu_count())
last = torch.channels_last

def conv(a, b, size, stride):
    return nn.Conv2d(a, b, size, stride, (size - 1) // 2)

def block(a, b, size):
    return [conv(a, b, size, 2 if size == 4 else 1), nn.BatchNorm2d(b), nn.LeakyReLU(0.2)]

def halving(a, b):
    return nn.Sequential(*block(a, b, 4))

def same(a, b):
    return nn.Sequential(*block(a, b, 3))

def doubled(x):
    return F.interpolate(x, scale_factor=2, mode='nearest')

def contrast(x):
    grey = x.mean(1, keepdim=True)
    wide = F.avg_pool2d(grey, (31, 1), 1, (15, 0), count_include_pad=False)
    return grey - F.avg_pool2d(wide, (1, 31), 1, (0, 15), count_include_pad=False)

def seen(x, contrasted):
    return torch.cat([(x - 0.5) * 2, contrasted * 4], 1).contiguous(memory_format=last)

def rings_seen(x):
    grey = x.mean(1)
    side, line = grey.size(2), torch.hann_window(grey.size(2))
    texture, window = grey / grey.mean((1, 2), keepdim=True).clamp_min(0.02), line.view(-1, 1) * line
    centred = texture - (texture * window).sum((1, 2), keepdim=True) / window.sum()
    powers = torch.fft.rfft2(centred * window).abs().square() / window.square().sum()
    return (torch.log(powers.flatten(1) @ half_averages + 1e-5) + 4) / 2

def statistics(x):
    flat = x.flatten(2)
    return torch.cat([flat.mean(2), (flat.var(2, False) + 1e-5).sqrt()], 1)

class Summary(nn.Module):
    def __init__(self):
        super().__init__()
        self.half = nn.Sequential(conv(4, c, 4, 2), nn.LeakyReLU(0.2))
        self.quarter, self.eighth, self.sixteenth = halving(c, 2 * c), halving(2 * c, 4 * c), halving(4 * c, 4 * c)
        self.hidden, self.summary = nn.Linear(22 * c + rings, 8 * c), nn.Linear(8 * c, 4 * c)

    def forward(self, x):
        half = self._modules['half'](seen(x, contrast(x)))
        quarter = self.quarter(half)
        eighth = self.eighth(quarter)
        every = [statistics(f) for f in (half, quarter, eighth, self.sixteenth(eighth))]
        spectrum = rings_seen(x)
        hidden = F.leaky_relu(self.hidden(torch.cat(every + [spectrum], 1)), 0.2)
        return F.leaky_relu(self.summary(hidden), 0.2), spectrum

class Height(nn.Module):
    def __init__(self):
        super().__init__()
        self.summary, self.rings = Summary(), nn.Linear(4 * c + rings, rings)
        self.full = nn.Sequential(conv(4, c, 3, 1), nn.LeakyReLU(0.2))
        self.half, self.quarter, self.eighth = halving(c, 2 * c), halving(2 * c, 4 * c), halving(4 * c, 4 * c)
        self.sixteenth = halving(4 * c, 6 * c)
        self.up_eighth, self.up_quarter = same(10 * c, 4 * c), same(8 * c, 2 * c)
        self.up_half, self.up_full = same(4 * c, c), same(2 * c, c)
        self.out = conv(c + 1, 1, 3, 1)

    def forward(self, x):
        contrasted = contrast(x)
        full = self.full(seen(x, contrasted))
        half = self._modules['half'](full)
        quarter = self.quarter(half)
        eighth = self.eighth(quarter)
        up = self.up_eighth(torch.cat([doubled(self.sixteenth(eighth)), eighth], 1))
        up = self.up_quarter(torch.cat([doubled(up), quarter], 1))
        up = self.up_half(torch.cat([doubled(up), half], 1))
        up = self.up_full(torch.cat([doubled(up), full], 1))
        return F.softplus(self.out(torch.cat([up, contrasted], 1)))

    def spectrum(self, x):
        return 2 * self.rings(torch.cat(self.summary(x), 1)) - 8

class Friction(nn.Module):
    def __init__(self):
        super().__init__()
        self.seed_shape = (-1, c, (rows + 3) // 4, (frames + 3) // 4)
        self.summary, self.mean = Summary(), nn.Linear(4 * c, 1)
        self.seed = nn.Linear(4 * c, c * self.seed_shape[2] * self.seed_shape[3])

        def doubling():
            return nn.Upsample(scale_factor=2, mode='nearest')

        self.decoder = nn.Sequential(doubling(), *block(c, c, 3), doubling(), *block(c, c, 3), conv(c, 1, 3, 1))

    def forward(self, x):
        summary, _ = self.summary(x)
        decoded = self.decoder(self.seed(summary).view(self.seed_shape))
        return decoded[:, :, :rows, :frames], torch.exp(self.mean(summary).clamp(-8, 8)) * mean_scale

class Bounded(nn.Module):
    def __init__(self, a, b, size, stride):
        super().__init__()
        self.padding, self.stride = ((size[0] - 1) // 2, (size[1] - 1) // 2) if stride else (0, 0), max(1, stride)
        self.weight, self.bias = nn.Parameter(torch.empty(b, a, *size)), nn.Parameter(torch.empty(b))
        self.register_buffer('direction', torch.empty(b))

    def forward(self, x):
        matrix = self.weight.flatten(1)

        def unit(v):
            return v / (v.norm() + 1e-12)

        with torch.no_grad():
            entry = unit(torch.mv(matrix.t(), self.direction))
            if self.training:
                self.direction.copy_(unit(torch.mv(matrix, entry)))
        weight = self.weight / (torch.dot(self.direction.clone(), torch.mv(matrix, entry)) + 1e-12)
        return F.conv2d(x, weight, self.bias, self.stride, self.padding)

class Discriminator(nn.Module):
    def __init__(self):
        super().__init__()

        def layer(a, b, size, stride):
            return Bounded(a, b, (size, size), stride)

        def leaky():
            return nn.LeakyReLU(0.2)

        self.surface = nn.Sequential(layer(4, c, 4, 2), leaky(), layer(c, 2 * c, 4, 2), leaky(), layer(2 * c, 4 * c, 4, 2), leaky())
        self.friction = nn.Sequential(layer(2, c, 4, 2), leaky(), layer(c, c, 4, 2), leaky(),
                                      Bounded(c, 2 * c, (rows // 4, frames // 4), 0), leaky())
        self.judge = nn.Sequential(layer(6 * c, 4 * c, 3, 1), leaky(), layer(4 * c, 1, 1, 1))

    def forward(self, x, friction, height):
        surface = self.surface(torch.cat([(x - 0.5) * 2, height], 1).contiguous(memory_format=last))
        ratio, mean = friction
        stroke = self.friction(torch.cat([ratio, mean.view(-1, 1, 1, 1).expand_as(ratio)], 1))
        return self.judge(torch.cat([surface, stroke.expand(-1, -1, surface.size(2), surface.size(3))], 1))

def tensors_in(path):
    """The tensors of a file in the layout of safetensors."""
    with open(path, 'rb') as file:
        header = json.loads(file.read(int.from_bytes(file.read(8), 'little')))
        data = file.read()
    kinds = {'F16': torch.float16, 'F32': torch.float32, 'I64': torch.int64}
    return {name: torch.frombuffer(bytearray(data[slice(*entry['data_offsets'])]), dtype=kinds[entry['dtype']])
            .reshape(entry['shape']) for name, entry in header.items() if name != '__metadata__'}

given = tensors_in(folder + '/peer.safetensors')
side = given['photograph'].size(3)
half_averages = given['ring_averages'].detach().view(rings, side, side)[:, :, :side // 2 + 1].clone()
half_averages[:, :, 1:-1] *= 2
half_averages = half_averages.flatten(1).t().contiguous()
height, friction, judge = Height(), Friction(), Discriminator()
parts = {'height.': height, 'friction.': friction, 'discriminator.': judge}
for prefix, part in parts.items():
    part.load_state_dict({name[len(prefix):]: value.detach() for name, value in given.items() if name.startswith(prefix)})
    part.to(memory_format=last)
x = given['photograph'].detach()
target = {name[7:]: value.detach() for name, value in given.items() if name.startswith('target_')}
truth = (target['ratio'], target['mean'])

def train_mode(on):
    for part in parts.values():
        part.train(on)

train_mode(False)
with torch.no_grad():
    made, stroke = height(x), friction(x)
    answers = {'height': made, 'rings': height.spectrum(x), 'ratio': stroke[0], 'mean': stroke[1],
               'logits': judge(x, stroke, made)}
apart = max((answers[name] - given['answer_' + name]).abs().max().item() for name in answers)
makers = list(height.parameters()) + list(friction.parameters())
steps = torch.optim.Adam(makers, 1e-3, (0.5, 0.999)), torch.optim.Adam(judge.parameters(), 5e-4, (0.5, 0.999))
losses = (0.0, 0.0)

def train():
    global losses
    train_mode(True)
    stroke, made = friction(x), height(x)
    steps[1].zero_grad()
    of_true = judge(x, truth, target['height'])
    of_made = judge(x, (stroke[0].detach(), stroke[1].detach()), made.detach())
    first = F.relu(1 - of_true).mean() + F.relu(1 + of_made).mean()
    first.backward()
    steps[1].step()
    steps[0].zero_grad()
    second = (-judge(x, stroke, made).mean() + (made - target['height']).abs().mean()
              + (height.spectrum(x) - target['rings']).abs().mean()
              + (stroke[0] - truth[0]).abs().mean() + (stroke[1] - truth[1]).abs().mean())
    second.backward()
    steps[0].step()
    losses = (first.item(), second.item())

def infer():
    if judge.training:
        train_mode(False)
    with torch.no_grad():
        friction(x[:1])
        height(x[:1])

def median(work, repeats):
    times = []
    for i in range(repeats):
        start = time.perf_counter()
        work()
        times.append(1000 * (time.perf_counter() - start))
    return sorted(times)[repeats // 2]

print('ready', torch.__version__, apart, flush=True)
for order in sys.stdin:
    order = order.strip()
    if order == 'train':
        print(median(train, 1), flush=True)
    elif order == 'infer':
        print(median(infer, 5), flush=True)
    elif order == 'losses':
        print(*losses, flush=True)
    else:
        break
