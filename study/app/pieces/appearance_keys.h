// How the program looks for this user: remembered between runs, and changed by keys in any of its windows (Ctrl +,
// Ctrl −, Ctrl 0, and Ctrl D for a dark room).
#pragma once

#include <QObject>
#include <QSettings>
#include <memory>

#include "study/app/state/appearance.h"

namespace study::app {

class AppearanceKeys : public QObject {
    Q_OBJECT
public:
    /// Takes what is remembered, and the keys of the window, which owns it. `settings` may be empty.
    AppearanceKeys(std::shared_ptr<QSettings> settings, QWidget& window);

    void set(const Appearance& appearance);

private:
    std::shared_ptr<QSettings> m_settings;
    QFont m_base;
    Appearance m_appearance;
};

}  // namespace study::app
