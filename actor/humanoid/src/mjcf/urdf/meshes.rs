//! Files of meshes that a URDF names.

use std::env;
use std::path::{Path, PathBuf};

/// Where files are looked for.
pub(super) struct Search<'a> {
    /// Folder of the URDF.
    pub(super) folder: &'a Path,
    /// Folders of packages that the user names.
    pub(super) packages: &'a [(String, PathBuf)],
    /// Folder that MuJoCo's `<compiler>` names, for files without their paths.
    pub(super) meshdir: Option<&'a str>,
}

impl Search<'_> {
    /// Returns the file that a URDF names, or else all paths where it was looked for.
    pub(super) fn find(&self, name: &str) -> Result<PathBuf, Vec<PathBuf>> {
        let tried = self.candidates(name);
        match tried.iter().find(|path| path.is_file()) {
            Some(found) => Ok(std::path::absolute(found).unwrap_or_else(|_| found.clone())),
            None => Err(tried),
        }
    }

    fn candidates(&self, name: &str) -> Vec<PathBuf> {
        let mut found = Vec::new();
        match ["package://", "model://"].iter().find_map(|scheme| name.strip_prefix(scheme)) {
            Some(path) => {
                let (package, within) = path.split_once('/').unwrap_or((path, ""));
                found.extend(
                    self.packages.iter().filter(|(name, _)| name == package).map(|(_, folder)| folder.join(within)),
                );
                let ros = env::var_os("ROS_PACKAGE_PATH").unwrap_or_default();
                let above = std::path::absolute(self.folder).unwrap_or_else(|_| self.folder.to_path_buf());
                let roots = env::split_paths(&ros).chain(above.ancestors().map(Path::to_path_buf));
                for root in roots.filter(|root| !root.as_os_str().is_empty()) {
                    // A root is the package itself or contains it.
                    if root.file_name().is_some_and(|last| last == package) {
                        found.push(root.join(within));
                    }
                    found.push(root.join(package).join(within));
                }
            }
            None => found.push(self.folder.join(name.strip_prefix("file://").unwrap_or(name))),
        }
        // As in MuJoCo, which strips the paths in a URDF.
        if let (Some(meshdir), Some(last)) = (self.meshdir, Path::new(name).file_name()) {
            found.push(self.folder.join(meshdir).join(last));
        }
        found
    }
}
