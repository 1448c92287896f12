// Pictures of the pages that a session of a draft will show: the operator's pages by their own widgets, and the participant's
// screen. Nothing in a picture can be pressed.
#pragma once

#include <QPixmap>
#include <QStringList>
#include <QWidget>
#include <memory>
#include <optional>

#include "protocols/protocol.h"
#include "study/session/session.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace study::app {

class PagePreview : public QWidget {
    Q_OBJECT
public:
    explicit PagePreview(QWidget* parent);

    /// Shows the pages of this protocol; none where it has faults. `phase`: whose pages are offered, from 0.
    void present(const std::optional<protocols::Protocol>& protocol, int phase);
    /// Shows the page of this question of the phase, from 0.
    void showQuestion(int question);
    /// Shows the participant's screen that has the sentence with this key (usualParticipantTexts()). Nothing for other sentences.
    void showText(const QString& key);
    QComboBox& choice() const { return *m_choice; }
    QSize sizeHint() const override;

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    /// A moment of a session, as the operator or the participant sees it.
    struct Moment {
        QString name;
        session::Stage stage;
        bool isOfParticipant = false;
        QStringList texts = {};  ///< first words of the keys of its sentences, on the participant's screen
    };
    std::vector<Moment> momentsOf(const protocols::Protocol& protocol) const;
    void draw();
    QPixmap pictureOf(const Moment& moment) const;
    int roomPx() const;
    void fit();

    std::optional<protocols::Protocol> m_protocol;
    int m_phase = 0;
    std::vector<Moment> m_moments;
    QComboBox* m_choice;
    QLabel* m_picture;
    QPixmap m_drawn;
};

}  // namespace study::app
