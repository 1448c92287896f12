#include "study/bench/peer_programs.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

extern char** environ;

namespace study::bench {

namespace {

constexpr const char* pythonTiming = R"(
import json, os, time
for name in ('OMP_NUM_THREADS', 'OPENBLAS_NUM_THREADS', 'MKL_NUM_THREADS'): os.environ[name] = '1'
def median(work, repeats):
    times = []
    for i in range(repeats):
        start = time.perf_counter(); work(); times.append(1000 * (time.perf_counter() - start))
    return sorted(times)[repeats // 2]
)";

// Each prints one JSON object: {"peer": {"stage": milliseconds or null}}.
constexpr const char* pythonScript = R"(
found = {'scipy': {'paired t': None, 'bca': None}, 'scikit-image': {'ssim': None, 'ssim float': None}}
try:
    import numpy, scipy.stats
    draw = numpy.random.default_rng(1)
    x, y, d = draw.random(1000000), draw.random(1000000), draw.normal(size=70).round(1)
    found['scipy']['paired t'] = median(lambda: scipy.stats.ttest_rel(x, y), 7)
    found['scipy']['bca'] = median(lambda: scipy.stats.bootstrap((d,), numpy.mean, n_resamples=10000, method='BCa'), 5)
except ImportError: pass
try:
    import numpy
    from skimage.metrics import structural_similarity as ssim
    draw = numpy.random.default_rng(1)
    a = draw.random((800, 1280)); b = 0.8 * a + 0.2 * draw.random((800, 1280))
    options = dict(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1.0)
    found['scikit-image']['ssim'] = median(lambda: ssim(a, b, **options), 3)
    a, b = a.astype('f4'), b.astype('f4')
    found['scikit-image']['ssim float'] = median(lambda: ssim(a, b, **options), 3)
except ImportError: pass
print(json.dumps(found))
)";

constexpr const char* rScript = R"(
median.ms <- function(work, repeats) median(sapply(seq_len(repeats), function(i) {
    start <- Sys.time(); work(); 1000 * as.numeric(difftime(Sys.time(), start, units = "secs")) }))
set.seed(1); x <- runif(1e6); y <- runif(1e6); d <- round(rnorm(70), 1)
t <- median.ms(function() t.test(x, y, paired = TRUE), 7)
bca <- median.ms(function() {
    means <- colMeans(matrix(sample(d, 70 * 10000, replace = TRUE), 70))
    z0 <- qnorm(mean(means < mean(d)) + mean(means == mean(d)) / 2)
    a <- sum((d - mean(d))^3) / (6 * sum((d - mean(d))^2)^1.5)
    z <- z0 + qnorm(c(.025, .975))
    quantile(means, pnorm(z0 + z / (1 - a * z))) }, 5)
cat(sprintf('{"R": {"paired t": %.4f, "bca": %.4f}}', t, bca))
)";

constexpr const char* signalScript = R"(
found = {'scipy': {}}
try:
    import numpy, scipy.fft
    draw = numpy.random.default_rng(1)
    p, q = draw.random((480, 640)).astype('f4'), draw.random((480, 640)).astype('f4')
    there = lambda a: scipy.fft.dctn(a, norm='ortho', workers=1)
    back = lambda a: scipy.fft.idctn(a, norm='ortho', workers=1)
    found['scipy']['cosine transforms 480x640'] = median(lambda: back(there(p)), 21)
    x = (2 * numpy.sin(numpy.pi * numpy.arange(640) / 1280)) ** 2
    y = (2 * numpy.sin(numpy.pi * numpy.arange(480) / 960)) ** 2
    value = (x[None] + y[:, None]).astype('f4'); value[0, 0] = 1
    def integrate():
        right = (p[:, 1:] + p[:, :-1]) / 2; down = (q[1:] + q[:-1]) / 2
        source = numpy.zeros_like(p)
        source[:, :-1] -= right; source[:, 1:] += right; source[:-1] -= down; source[1:] += down
        spectrum = there(source) / value; spectrum[0, 0] = 0
        return back(spectrum)
    found['scipy']['integration 480x640'] = median(integrate, 21)
except ImportError: pass
print(json.dumps(found))
)";

/// Standard output of a program; empty where it cannot be started or fails.
std::string outputOf(const std::vector<std::string>& command)
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> argv;
    for (const std::string& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const int failure = posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    std::string text;
    std::array<char, 4096> chunk{};
    for (ssize_t n = 0; failure == 0 && (n = read(ends[0], chunk.data(), chunk.size())) > 0;)
        text.append(chunk.data(), static_cast<std::size_t>(n));
    close(ends[0]);
    if (failure != 0) return {};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : std::string();
}

void add(PeerTimes& times, const std::string& output)
{
    const auto found = nlohmann::json::parse(output, nullptr, false);
    if (!found.is_object()) return;
    for (const auto& [peer, stages] : found.items())
        for (const auto& [stage, milliseconds] : stages.items())
            if (milliseconds.is_number()) times[stage][peer] = milliseconds.get<double>();
}

}  // namespace

PeerTimes peerTimes()
{
    PeerTimes times;
    for (const char* stage : {"paired t", "bca"}) times[stage] = {{"scipy", std::nullopt}, {"R", std::nullopt}};
    for (const char* stage : {"ssim", "ssim float"}) times[stage] = {{"scikit-image", std::nullopt}};
    add(times, outputOf({"/usr/bin/python3", "-c", std::string(pythonTiming) + pythonScript}));
    add(times, outputOf({"Rscript", "-e", rScript}));
    return times;
}

PeerTimes signalPeerTimes()
{
    PeerTimes times;
    for (const char* stage : {"cosine transforms 480x640", "integration 480x640"}) times[stage] = {{"scipy", std::nullopt}};
    add(times, outputOf({"/usr/bin/python3", "-c", std::string(pythonTiming) + signalScript}));
    return times;
}

}  // namespace study::bench
