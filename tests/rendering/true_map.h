// Reads the profilometer maps of the shared recordings (TMD version 2), and says where they are.
#pragma once

#include <QByteArray>
#include <QFile>
#include <QString>
#include <QtEndian>
#include <cstring>
#include <opencv2/core/mat.hpp>

struct TrueMap {
    cv::Mat heightMm;  ///< CV_32FC1; empty where the file is not there
    double xPitchMm = 0, yPitchMm = 0;
};

inline QString sharedData(const QString& name)
{
    const QString shared = qEnvironmentVariable("VIS2HAP_SHARED", VIS2HAP_SOURCE_DIR "/../shared");
    return shared + "/data/" + name;
}

inline TrueMap readTrueMap(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return {};
    const QByteArray bytes = file.readAll();
    const qsizetype start = bytes.indexOf('\0', 32) + 1;
    const auto whole = [&](qsizetype at) { return static_cast<int>(qFromLittleEndian<quint32>(bytes.constData() + start + at)); };
    const auto real = [&](qsizetype at) {
        float value = 0;
        std::memcpy(&value, bytes.constData() + start + at, sizeof value);
        return value;
    };
    const int columns = whole(0), rows = whole(4);
    TrueMap map{cv::Mat(rows, columns, CV_32FC1), real(8) / columns, real(12) / rows};
    if (bytes.size() < start + 24 + static_cast<qsizetype>(4) * rows * columns) return {};
    std::memcpy(map.heightMm.data, bytes.constData() + start + 24,
                static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) * 4);
    return map;
}
