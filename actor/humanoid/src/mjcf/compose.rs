//! Composed models: `<replicate>` and `<attach>`, written out as plain elements.
//!
//! As in MuJoCo, every name in a copied part of the tree is changed, and elements outside of the tree that name a part of it
//! are copied with it.

mod element_tree;
mod names;

use std::path::Path;

use nalgebra::Vector3;
use roxmltree::Document;

use self::element_tree::Piece;
use self::names::{Change, Names};
use super::element::{Element, numbers};
use super::files::{self, AssetFiles};
use super::pose::{Angles, Pose};
use super::vocabulary;
use super::xml;
use crate::error::ModelError;

/// Most replicas of an element.
const REPLICAS_MAX: usize = 1024;
/// Deepest chain of models attached to each other, and most attachments of models in all of them.
const DEPTH_MAX: usize = 8;
const ATTACHMENTS_MAX: usize = 256;
/// Most `<replicate>` and `<attach>` of a text.
const COPIES_MAX: usize = 1024;
/// Sections whose elements name parts of the tree, in the order in which they may name each other.
const SECTIONS: [&str; 4] = ["tendon", "contact", "equality", "actuator"];
/// Settings of `<compiler>` that hold for a whole text, and their defaults.
const COMPILER: [(&str, &str); 9] = [
    ("angle", "degree"),
    ("eulerseq", "xyz"),
    ("autolimits", "true"),
    ("inertiafromgeom", "auto"),
    ("inertiagrouprange", "0 5"),
    ("balanceinertia", "false"),
    ("boundmass", "0"),
    ("boundinertia", "0"),
    ("settotalmass", "-1"),
];

/// Returns the text of a model file with all included files and all copies written out.
pub(super) fn whole_text(path: &Path) -> Result<String, ModelError> {
    let text = files::text_with_includes(path)?;
    let document = xml::parse(&text)?;
    let root = Piece::of(document.root_element());
    if !root.has_below(&is_copy) {
        return Ok(text);
    }
    let text = Composition::of(root, files::folder_of(path), 0, &mut 0)?.to_text();
    files::check_length(text.len() as u64)?;
    Ok(text)
}

/// Returns whether an element stands for others.
fn is_copy(node: &Piece) -> bool {
    node.tag == "replicate" || node.tag == "attach"
}

/// A text whose copies are written out one after the other.
struct Composition<'a> {
    root: Piece,
    folder: &'a Path,
    depth: usize,
    /// Attachments of models so far, also by models that are attached.
    attachments: &'a mut usize,
    /// Length of all copies so far (bytes).
    copied: u64,
    /// Number of `<replicate>` and `<attach>` so far.
    copies: usize,
    angles: Angles,
    /// Models that a part of has been attached, by prefix: their assets and classes are there.
    attached: Vec<(String, String)>,
    /// The tree as it was, for parts that are attached to another place of it.
    worlds: Vec<Piece>,
}

impl Composition<'_> {
    fn of(mut root: Piece, folder: &Path, depth: usize, attachments: &mut usize) -> Result<Piece, ModelError> {
        let compiler = |name: &str| root.setting("compiler", name).map(str::to_owned);
        let sequence = compiler("eulerseq").unwrap_or_else(|| "xyz".to_owned());
        let angles = Angles { are_degrees: compiler("angle").as_deref() != Some("radian"), sequence };
        let attaches_models = root.has_below(&|node: &Piece| node.tag == "attach" && node.get("model").is_some());
        if attaches_models {
            root.check_defaults()?;
            root.isolate("treadmill_own");
        }
        let mut worlds = root.take_all("worldbody");
        let mut composition = Composition {
            root,
            folder,
            depth,
            attachments,
            copied: 0,
            copies: 0,
            angles,
            attached: Vec::new(),
            worlds: worlds.clone(),
        };
        for world in &mut worlds {
            composition.expand(world)?;
        }
        let mut root = composition.root;
        root.children.retain(|section| section.tag != "sensor");
        for assets in root.children.iter_mut().filter(|section| section.tag == "asset") {
            assets.children.retain(|asset| asset.tag != "model");
        }
        root.children.extend(worlds);
        Ok(root)
    }

    /// Writes out the copies within an element of the tree.
    fn expand(&mut self, parent: &mut Piece) -> Result<(), ModelError> {
        for mut child in std::mem::take(&mut parent.children) {
            match child.tag.as_str() {
                "replicate" => self.replicate(child, parent)?,
                "attach" => parent.children.push(self.attach(&child)?),
                _ => {
                    self.expand(&mut child)?;
                    parent.children.push(child);
                }
            }
        }
        Ok(())
    }

    fn replicate(&mut self, mut replicate: Piece, parent: &mut Piece) -> Result<(), ModelError> {
        let element = replicate.element("replicate");
        vocabulary::check("replicate", &element)?;
        let count: usize = element.whole("count", 0)?;
        if !(1..=REPLICAS_MAX).contains(&count) {
            return Err(element.wrong("count", format!("a whole number from 1 to {REPLICAS_MAX}")));
        }
        self.expand(&mut replicate)?;
        let separator = element.text("sep");
        // As in MuJoCo, those of the count, not of the last number.
        let digits = count.to_string().len();
        let change = |number: usize| Change::Suffix(format!("{separator}{number:0digits$}"));
        let length: u64 = replicate.children.iter().map(Piece::length).sum();
        self.check_size(count as u64 * length)?;
        let names = Names::within(&replicate.children);
        let (offset_m, angles) = (element.list_over("offset", [0.0; 3]), element.list_over("euler", [0.0; 3]));
        let mut place_m = Vector3::zeros();
        for number in 0..count {
            // As in MuJoCo, the angles grow, which is not the same turn again and again; each step is along the turned axes.
            let pose = self.angles.turned_at(place_m, angles.map(|angle| number as f64 * angle));
            place_m += pose.isometry().rotation * Vector3::from(offset_m);
            let mut frame = Piece::frame(&pose);
            frame.children.clone_from(&replicate.children);
            frame.children.iter_mut().for_each(|child| names.apply(child, &change(number)));
            parent.children.push(frame);
        }
        let changes: Vec<Change> = (0..count).map(change).collect();
        let copies = self.copies(names, &changes)?;
        self.root.add_all(copies);
        Ok(())
    }

    /// Returns a frame with the part of a model that an `<attach>` names.
    fn attach(&mut self, attach: &Piece) -> Result<Piece, ModelError> {
        let element = attach.element("attach");
        vocabulary::check("attach", &element)?;
        let prefix = element.get("prefix").ok_or_else(|| element.refused("`prefix` is missing"))?.to_owned();
        let mut other = element.get("model").map(|model| self.model(&element, model, &prefix)).transpose()?;
        let part = |name: &str| match &other {
            // Names of the other model have the prefix already.
            Some(_) => format!("{prefix}{name}"),
            None => name.to_owned(),
        };
        let source = other.as_ref().map_or(&self.worlds, |other| &other.children);
        let mut worlds = source.iter().filter(|section| section.tag == "worldbody");
        let (mut found, class) = match (element.get("body"), element.get("frame")) {
            (Some(_), Some(_)) => return Err(element.refused("give either `body` or `frame`, not both")),
            (None, None) if other.is_none() => return Err(element.refused("give `model`, `body` or `frame`")),
            (None, None) => (worlds.flat_map(|world| world.children.clone()).collect(), None),
            (body, frame) => {
                let (tag, name) = body.map_or(("frame", frame.unwrap_or_default()), |body| ("body", body));
                let wanted = part(name);
                let is_it = |node: &Piece| node.tag == tag && node.get("name") == Some(wanted.as_str());
                let found = worlds.find_map(|world| world.find(&is_it, None));
                let (found, class) = found.ok_or_else(|| element.refused(format!("there is no {tag} `{name}`")))?;
                (vec![found], class)
            }
        };
        if found.iter().any(|part| part.has_below(&is_copy)) {
            return Err(element.refused("what it attaches has a <replicate> or <attach> in it; attach its parts"));
        }
        let names = Names::within(&found);
        let copies = match &mut other {
            Some(other) => copies(other, names, &[Change::None], Kind::OfOther),
            None => {
                let change = Change::Prefix(prefix);
                found.iter_mut().for_each(|part| names.apply(part, &change));
                copies(&mut self.root, names, &[change], Kind::Beside)
            }
        };
        self.count_copies()?;
        let all = copies.iter().flat_map(|(_, elements)| elements).chain(&found);
        self.check_size(all.map(Piece::length).sum())?;
        self.root.add_all(copies);
        let mut frame = Piece::frame(&Pose::IDENTITY);
        // The class of what surrounds it there, not here.
        frame.set("childclass", class.as_deref().unwrap_or("main"));
        frame.children = found;
        Ok(frame)
    }

    /// Returns another model with `prefix` before all of its names, and takes over its assets and classes.
    fn model(&mut self, attach: &Element, name: &str, prefix: &str) -> Result<Piece, ModelError> {
        if self.depth == DEPTH_MAX {
            return Err(attach.refused(format!("models are attached to each other more than {DEPTH_MAX} deep")));
        }
        *self.attachments += 1;
        if *self.attachments > ATTACHMENTS_MAX {
            return Err(attach.refused(format!("models are attached more than {ATTACHMENTS_MAX} times")));
        }
        let assets = self.root.children.iter().filter(|section| section.tag == "asset").flat_map(|all| &all.children);
        let mut file = None;
        for model in assets.filter(|asset| asset.tag == "model") {
            let of_model = model.get("file").unwrap_or_default();
            let is_it = match model.get("name") {
                Some(own) => own == name,
                // Without a name it has that of the file's outermost element.
                None => {
                    let text = files::text_with_includes(&self.folder.join(of_model))?;
                    xml::parse(&text)?.root_element().attribute("model") == Some(name)
                }
            };
            if is_it {
                file = Some(of_model.to_owned());
                break;
            }
        }
        let file = file.ok_or_else(|| attach.refused(format!("there is no <model> `{name}` among the assets")))?;
        let path = self.folder.join(&file);
        let folder = files::folder_of(&path);
        let text = files::text_with_includes(&path)?;
        let text = with_whole_paths(&xml::parse_model(&text)?, folder)?;
        let document = xml::parse_model(&text)?;
        let mut other = Composition::of(Piece::of(document.root_element()), folder, self.depth + 1, self.attachments)?;
        for (setting, default) in COMPILER {
            let [own, of_other] = [&self.root, &other].map(|root| root.setting("compiler", setting).unwrap_or(default));
            let are_equal = own == of_other || numbers(own).is_some_and(|own| Some(own) == numbers(of_other));
            if !are_equal {
                let problem = format!(
                    "`{setting}` in the <compiler> of `{file}` is \"{of_other}\", but \"{own}\" in this model; give both the same"
                );
                return Err(attach.refused(problem));
            }
        }
        other.check_defaults()?;
        other.rename_all(prefix);
        if !self.attached.iter().any(|(model, before)| model == name && before == prefix) {
            self.attached.push((name.to_owned(), prefix.to_owned()));
            if other.children.iter().any(|section| section.tag == "keyframe") {
                let note = format!("the keyframes of `{file}`, which is attached as `{prefix}`, are left out");
                self.root.children.push(Piece::note(&format!("attach_{}", self.attached.len()), note));
            }
            let taken: Vec<Piece> = other.take_all("asset").into_iter().chain(other.take_all("default")).collect();
            self.root.children.extend(taken);
        }
        Ok(other)
    }

    /// Replaces the elements outside of the tree that name a part of it by copies, one after the other.
    fn copies(&mut self, names: Names, changes: &[Change]) -> Result<Vec<(&'static str, Vec<Piece>)>, ModelError> {
        let sections = self.root.children.iter().filter(|section| SECTIONS.contains(&&*section.tag));
        let referring = sections.flat_map(|section| &section.children).filter(|element| names.are_in(element));
        let length: u64 = referring.map(Piece::length).sum();
        self.check_size(changes.len() as u64 * length)?;
        self.count_copies()?;
        Ok(copies(&mut self.root, names, changes, Kind::Replaced))
    }

    /// Counts a `<replicate>` or `<attach>`; refuses more than can be written out in a moment.
    fn count_copies(&mut self) -> Result<(), ModelError> {
        self.copies += 1;
        if self.copies > COPIES_MAX {
            let problem = format!("there are more than {COPIES_MAX} <replicate> and <attach>");
            return Err(ModelError::unsupported("worldbody", problem));
        }
        Ok(())
    }

    /// Notes the length of what is copied; refuses texts that would become too long, before they do.
    fn check_size(&mut self, copied: u64) -> Result<(), ModelError> {
        self.copied = self.copied.saturating_add(copied);
        files::check_length(self.copied)
    }
}

/// What becomes of the elements outside of the tree that name a copied part.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// The copies take their place.
    Replaced,
    /// The copies are beside them.
    Beside,
    /// They are those of another model, of which only the part is here.
    OfOther,
}

/// Returns, by section, copies of the elements of a text that name one of these parts. As in MuJoCo, equalities that also
/// name another part have no copies, and elements of another model neither.
fn copies(root: &mut Piece, mut names: Names, changes: &[Change], kind: Kind) -> Vec<(&'static str, Vec<Piece>)> {
    let mut found = Vec::new();
    for tag in SECTIONS {
        let mut originals = Vec::new();
        for section in root.children.iter_mut().filter(|section| section.tag == tag) {
            let (referring, others): (Vec<Piece>, Vec<Piece>) =
                std::mem::take(&mut section.children).into_iter().partition(|element| names.are_in(element));
            section.children = others;
            if kind != Kind::Replaced {
                section.children.extend(referring.iter().cloned());
            }
            let must_be_whole = tag == "equality" || kind == Kind::OfOther;
            originals.extend(referring.into_iter().filter(|element| !must_be_whole || names.have_all_of(element)));
        }
        // A tendon's name is one of the names that change.
        names.add(tag, &originals);
        let copy = |original: &Piece, change: &Change| {
            let mut copy = original.clone();
            names.apply(&mut copy, change);
            copy
        };
        let all = changes.iter().flat_map(|change| originals.iter().map(move |original| copy(original, change)));
        found.push((tag, all.collect()));
    }
    found
}

/// Returns a text in which the files of all assets have whole paths.
fn with_whole_paths(document: &Document<'_>, folder: &Path) -> Result<String, ModelError> {
    let text = document.input_text();
    let found = AssetFiles::of(document, folder)?;
    let (mut whole, mut done) = (String::new(), 0);
    for (node, asset) in &found.assets {
        let Some((path, file)) = found.path_of(asset).zip(node.attribute_node("file")) else { continue };
        let path = std::path::absolute(&path).unwrap_or(path);
        whole.push_str(&text[done..file.range_value().start]);
        xml::escape(&mut whole, &path.to_string_lossy());
        done = file.range_value().end;
    }
    whole.push_str(&text[done..]);
    Ok(whole)
}
