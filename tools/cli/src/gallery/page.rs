//! The page of the gallery: static HTML beside the sheets.

use super::sheets::Sheet;

const STYLE: &str = "\
body { margin: 2rem auto; max-width: 1900px; padding: 0 1rem; background: #f4f5f7; color: #30343c; \
font: 1rem/1.5 system-ui, sans-serif }
figure { margin: 0 0 3rem }
figcaption { max-width: 60rem; margin-bottom: .5rem }
img { max-width: 100%; height: auto; border-radius: 4px }
nav a { margin-right: 1rem }";

/// The whole page.
pub(super) fn html(sheets: &[Sheet]) -> String {
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Hikage: gallery</title>\n\
         <style>\n{STYLE}\n</style>\n<h1>Hikage</h1>\n<p>Every look on the built-in character, as \
         <code>hikage gallery</code> {} drew it. Names in brackets are sections of a look file.</p>\n<nav>",
        env!("CARGO_PKG_VERSION")
    );
    for sheet in sheets {
        text += &format!("<a href=\"#{}\">{}</a>\n", sheet.name, escaped(sheet.title));
    }
    text += "</nav>\n";
    for sheet in sheets {
        let (name, title) = (sheet.name, escaped(sheet.title));
        text += &format!(
            "<figure id=\"{name}\">\n<h2>{title}</h2>\n<figcaption>{}</figcaption>\n\
             <a href=\"{name}.png\"><img src=\"{name}.png\" alt=\"{title}\" loading=\"lazy\"></a>\n</figure>\n",
            escaped(sheet.caption)
        );
    }
    text + "</html>\n"
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::super::sheets;

    #[test]
    fn the_page_shows_every_sheet_once() {
        let sheets = sheets::all();
        let page = super::html(&sheets);
        for sheet in &sheets {
            assert_eq!(page.matches(&format!("src=\"{}.png\"", sheet.name)).count(), 1, "{}", sheet.name);
        }
        assert_eq!(page.matches("<figure").count(), sheets.len());
    }
}
