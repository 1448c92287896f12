// Page of the participant's screen: opens the instruction on a second screen of this computer, or as a page for a tablet's
// browser in the same room, with its address and code.
#pragma once

#include <QWidget>
#include <memory>

#include "study/app/participant/participant_side.h"
#include "study/app/participant/participant_sound.h"
#include "study/app/participant/participant_window.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace study::app {

class MessageBar;

class ParticipantPage : public QWidget {
    Q_OBJECT
public:
    /// `side` and `sound` must outlive the page.
    ParticipantPage(ParticipantSide& side, ParticipantSound& sound, QWidget* parent);
    ~ParticipantPage() override;

    /// Lists the screens and networks of this moment.
    void present();
    void focusFirst();
    void closeWindow();

Q_SIGNALS:
    void backRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void build();
    void listScreens();
    void listNetworks();
    void toggleWindow();
    void togglePage();
    void toggleSound();
    double noise() const;
    Speech speech() const;
    QString promptsText() const;
    void showState();
    void showSound();

    ParticipantSide& m_side;
    ParticipantSound& m_sound;
    std::unique_ptr<ParticipantWindow> m_window;
    QComboBox* m_screen;
    QPushButton* m_open;
    QLabel* m_screenState;
    QComboBox* m_network;
    QPushButton* m_start;
    QPushButton* m_newCode;
    QPushButton* m_back;
    QLabel* m_address;
    QLabel* m_code;
    QLabel* m_state;
    QComboBox* m_noise;
    QComboBox* m_speech;
    QPushButton* m_startSound;
    QPushButton* m_try;
    QLabel* m_soundState;
    QLabel* m_speechState;
    MessageBar* m_message;
};

}  // namespace study::app
