// Tail probabilities of test statistics when the null hypothesis is false; they give the power of a test.
#pragma once

namespace stats {

/// P(T >= t), noncentral t.
double noncentralStudentUpper(double t, double df, double noncentrality);
/// P(F >= f), noncentral F; noncentrality of the numerator, >= 0.
double noncentralFisherUpper(double f, double df1, double df2, double noncentrality);
/// P(X >= x), noncentral chi-squared.
double noncentralChiSquaredUpper(double x, double df, double noncentrality);

/// The F and the chi-squared that are exceeded with probability `upperTail` under the null hypothesis.
double fisherQuantile(double upperTail, double df1, double df2);
double chiSquaredQuantile(double upperTail, double df);

}  // namespace stats
