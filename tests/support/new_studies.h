// Small studies for tests, each in a folder and with keys of its own, because they lie beside each other.
#pragma once

#include <QString>
#include <QTemporaryDir>

#include "tests/support/study_builder.h"

namespace tests::support {

class NewStudies {
public:
    database::StudyFolder make()
    {
        const std::string folder = m_place.filePath(QString("study%1").arg(++m_studies)).toStdString();
        return buildStudy(folder, {.keySeed = static_cast<std::uint64_t>(m_studies)});
    }
    /// The folder in which they lie.
    const QTemporaryDir& place() const { return m_place; }

private:
    QTemporaryDir m_place;
    int m_studies = 0;
};

}  // namespace tests::support
