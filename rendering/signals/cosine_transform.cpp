#include "rendering/signals/cosine_transform.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

namespace rendering::signals {

namespace {

/// e^(i pi k / 2N)
std::vector<std::complex<double>> quarterTurns(int n)
{
    std::vector<std::complex<double>> turns(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) turns[static_cast<std::size_t>(k)] = std::polar(1.0, std::numbers::pi * k / (2.0 * n));
    return turns;
}

double weight(int k, int n) { return std::sqrt((k == 0 ? 1.0 : 2.0) / n); }

/// Where sample j of a row goes: the even samples forwards, then the odd ones backwards.
int shuffled(int j, int n) { return j % 2 == 0 ? j / 2 : n - 1 - j / 2; }

template <class T>
cv::Mat oddRows(const cv::Mat& values)
{
    const int n = values.cols;
    cv::Mat ordered(values.size(), values.type());
    for (int i = 0; i < values.rows; ++i)
        for (int j = 0; j < n; ++j) ordered.at<T>(i, shuffled(j, n)) = values.at<T>(i, j);
    cv::Mat spectrum;
    cv::dft(ordered, spectrum, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
    const auto turns = quarterTurns(n);
    for (int i = 0; i < values.rows; ++i)
        for (int k = 0; k < n; ++k) {
            const auto v = spectrum.at<cv::Vec<T, 2>>(i, k);
            const auto& turn = turns[static_cast<std::size_t>(k)];
            ordered.at<T>(i, k) = static_cast<T>(weight(k, n) * (turn.real() * v[0] + turn.imag() * v[1]));
        }
    return ordered;
}

template <class T>
cv::Mat inverseOddRows(const cv::Mat& coefficients)
{
    const int n = coefficients.cols;
    const auto turns = quarterTurns(n);
    cv::Mat spectrum(coefficients.size(), CV_MAKETYPE(coefficients.depth(), 2));
    for (int i = 0; i < coefficients.rows; ++i)
        for (int k = 0; k < n; ++k) {
            const double real = coefficients.at<T>(i, k) / weight(k, n);
            const double imaginary = k == 0 ? 0.0 : -coefficients.at<T>(i, n - k) / weight(n - k, n);
            const auto v = turns[static_cast<std::size_t>(k)] * std::complex<double>(real, imaginary);
            spectrum.at<cv::Vec<T, 2>>(i, k) = {static_cast<T>(v.real()), static_cast<T>(v.imag())};
        }
    cv::Mat ordered;
    cv::dft(spectrum, ordered, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_ROWS | cv::DFT_REAL_OUTPUT);
    cv::Mat values(coefficients.size(), coefficients.type());
    for (int i = 0; i < values.rows; ++i)
        for (int j = 0; j < n; ++j) values.at<T>(i, j) = ordered.at<T>(i, shuffled(j, n));
    return values;
}

cv::Mat rows(const cv::Mat& values, bool inverse)
{
    if (values.cols == 1) return values.clone();
    if (values.cols % 2 == 0) {
        cv::Mat result;
        cv::dct(values, result, cv::DCT_ROWS | (inverse ? cv::DCT_INVERSE : 0));
        return result;
    }
    const bool isDouble = values.depth() == CV_64F;
    if (inverse) return isDouble ? inverseOddRows<double>(values) : inverseOddRows<float>(values);
    return isDouble ? oddRows<double>(values) : oddRows<float>(values);
}

cv::Mat transformed(const cv::Mat& values, bool inverse)
{
    CV_Assert(!values.empty() && (values.type() == CV_32FC1 || values.type() == CV_64FC1));
    cv::Mat result;
    if (values.rows % 2 == 0 && values.cols % 2 == 0) {
        cv::dct(values, result, inverse ? cv::DCT_INVERSE : 0);
        return result;
    }
    cv::Mat turned;
    cv::transpose(rows(values, inverse), turned);
    cv::transpose(rows(turned, inverse), result);
    return result;
}

}  // namespace

cv::Mat cosineTransform(const cv::Mat& values) { return transformed(values, false); }

cv::Mat inverseCosineTransform(const cv::Mat& coefficients) { return transformed(coefficients, true); }

}  // namespace rendering::signals
