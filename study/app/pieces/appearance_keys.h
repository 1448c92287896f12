// Appearance of the program for this user. It is stored between runs and changed by keys in every window: Ctrl +, Ctrl −,
// Ctrl 0, and Ctrl D for the next theme. Text also grows with the main window.
#pragma once

#include <QObject>
#include <QSettings>
#include <memory>

#include "study/app/state/appearance.h"

namespace study::app {

class AppearanceKeys : public QObject {
    Q_OBJECT
public:
    enum class Growth { WithWindow, None };
    /// Applies the stored appearance and handles the keys in `window`, which owns this object. `settings` may be null.
    AppearanceKeys(std::shared_ptr<QSettings> settings, QWidget& window, Growth growth = Growth::None);

    void set(const Appearance& appearance);
    /// Takes the next size of the text that the window can show; the last one stays.
    void enlarge() { takeNextSize(larger); }
    void reduce() { takeNextSize(smaller); }
    void changeTheme() { set({nextTheme(m_appearance.theme), m_appearance.textPercent}); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void grow();
    void takeNextSize(Appearance (*next)(Appearance));

    std::shared_ptr<QSettings> m_settings;
    QWidget& m_window;
    QFont m_base;
    Appearance m_appearance;
};

}  // namespace study::app
