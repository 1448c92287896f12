# R on the work of `vis2hap bench statistics`. Prints {"R": {"stage": milliseconds}}.
median.ms <- function(work, repeats) median(sapply(seq_len(repeats), function(i) {
    start <- Sys.time()
    work()
    1000 * as.numeric(difftime(Sys.time(), start, units = "secs"))
}))
set.seed(1)
x <- runif(1e6)
y <- runif(1e6)
d <- round(rnorm(70), 1)
t <- median.ms(function() t.test(x, y, paired = TRUE), 7)
bca <- median.ms(function() {
    means <- colMeans(matrix(sample(d, 70 * 10000, replace = TRUE), 70))
    z0 <- qnorm(mean(means < mean(d)) + mean(means == mean(d)) / 2)
    a <- sum((d - mean(d))^3) / (6 * sum((d - mean(d))^2)^1.5)
    z <- z0 + qnorm(c(.025, .975))
    quantile(means, pnorm(z0 + z / (1 - a * z)))
}, 5)
cat(sprintf('{"R": {"paired t": %.4f, "bca": %.4f}}', t, bca))
