// Bar below the pages: how this station stands with the server of the study. Hidden for a study in a folder.
#pragma once

#include "study/app/pieces/pieces.h"
#include "study/app/state/open_study.h"

namespace study::app {

class ServerBar : public MessageBar {
    Q_OBJECT
public:
    explicit ServerBar(QWidget* parent) : MessageBar("serverBar", parent) {}

    /// `link`: none for a study in a folder.
    void present(const std::optional<database::StationStore::Link>& link);

private:
    /// Why no entry reaches the server; empty where each does.
    static QString faultOf(const database::StationStore::Link& link);
    static QString lossOf(const database::StationStore::Link& link);
    static QString clockFaultOf(const database::StationStore::Link& link);
};

}  // namespace study::app
