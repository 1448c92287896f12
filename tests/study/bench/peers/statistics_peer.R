# R on the work of `vis2hap bench statistics`, with the same numbers. Prints {"R": {"stage": {"ms": X, "answer": Y}}}.
median.ms <- function(work, repeats) median(sapply(seq_len(repeats), function(i) {
    start <- Sys.time()
    work()
    1000 * as.numeric(difftime(Sys.time(), start, units = "secs"))
}))
# The products stay below 2^53, so doubles hold them exactly.
sequence <- function(n, multiplier, increment) {
    i <- seq_len(n) - 1
    ((i * multiplier + increment) %% 4294967296) / 4294967296
}
x <- sequence(1e6, 2654435761, 12345)
y <- sequence(1e6, 3266489917, 99)
d <- round((sequence(70, 2654435761, 777) - 0.45) * 60) / 10
set.seed(1)
t.work <- function() t.test(x, y, paired = TRUE)
bca.work <- function() {
    means <- colMeans(matrix(sample(d, 70 * 10000, replace = TRUE), 70))
    z0 <- qnorm(mean(means < mean(d)) + mean(means == mean(d)) / 2)
    a <- sum((d - mean(d))^3) / (6 * sum((d - mean(d))^2)^1.5)
    z <- z0 + qnorm(c(.025, .975))
    quantile(means, pnorm(z0 + z / (1 - a * z)))
}
cat(sprintf('{"R": {"paired t": {"ms": %.4f, "answer": %.17g}, "bca": {"ms": %.4f, "answer": %.17g}}}',
            median.ms(t.work, 7), t.work()$statistic, median.ms(bca.work, 5), bca.work()[1]))
