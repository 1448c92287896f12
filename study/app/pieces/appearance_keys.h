// Appearance of the program for this user. It is stored between runs and changed by keys in every window: Ctrl +, Ctrl −,
// Ctrl 0, and Ctrl D for a dark room.
#pragma once

#include <QObject>
#include <QSettings>
#include <memory>

#include "study/app/state/appearance.h"

namespace study::app {

class AppearanceKeys : public QObject {
    Q_OBJECT
public:
    /// Applies the stored appearance and handles the keys in `window`, which owns this object. `settings` may be null.
    AppearanceKeys(std::shared_ptr<QSettings> settings, QWidget& window);

    void set(const Appearance& appearance);

private:
    std::shared_ptr<QSettings> m_settings;
    QFont m_base;
    Appearance m_appearance;
};

}  // namespace study::app
