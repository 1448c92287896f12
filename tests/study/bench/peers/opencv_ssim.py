"""The usual recipe for structural similarity by OpenCV's filters (its tutorial on video input), on valid windows only."""
import cv2


def ssim(a, b, data_range):
    c1, c2 = (0.01 * data_range) ** 2, (0.03 * data_range) ** 2

    def smooth(image):
        return cv2.GaussianBlur(image, (11, 11), 1.5)

    mean_a, mean_b = smooth(a), smooth(b)
    variance_a = smooth(a * a) - mean_a * mean_a
    variance_b = smooth(b * b) - mean_b * mean_b
    covariance = smooth(a * b) - mean_a * mean_b
    similarity = (((2 * mean_a * mean_b + c1) * (2 * covariance + c2))
                  / ((mean_a ** 2 + mean_b ** 2 + c1) * (variance_a + variance_b + c2)))
    inner = similarity[5:-5, 5:-5] if min(a.shape) >= 11 else similarity
    return inner.mean()
