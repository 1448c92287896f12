// The section of the conditions: the rendered ones with a sentence each, conditions at several qualities, and conditions of the
// lab's own with ready images.
#pragma once

#include <QWidget>
#include <string>
#include <vector>

class QComboBox;
class QLineEdit;
class QListWidget;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class DraftFields;
class MessageBar;
class TickBox;

class ConditionsSection : public QWidget {
    Q_OBJECT
public:
    ConditionsSection(DraftFields& fields, QWidget* parent);

    /// The folder of the protocol file, from which relative folders of images count.
    void setFolder(const QString& folder) { m_folder = folder; }

private:
    void buildRendered(QVBoxLayout& column);
    void buildFurther(QVBoxLayout& column);
    void present();
    void browse();
    enum class Made { InFolder, ByProgram };
    void addOwn(Made made);
    void addQuality();
    void removeFurther();

    DraftFields& m_fields;
    QString m_folder;
    struct Offered {
        std::string id;
        TickBox* tick;
    };
    std::vector<Offered> m_rendered;
    QListWidget* m_further;
    std::vector<std::size_t> m_places;  ///< of the rows of `m_further` in the list of the draft
    QPushButton* m_remove;
    QLineEdit* m_ownId;
    QLineEdit* m_ownFolder;
    QPushButton* m_addOwn;
    QPushButton* m_addProgram;
    QPushButton* m_browse;
    QComboBox* m_row;
    QComboBox* m_quality;
    QPushButton* m_addQuality;
    MessageBar* m_message;
};

}  // namespace study::app
