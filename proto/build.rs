//! Compiles the schemas with `protox`, which needs no installed `protoc`.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=schema");
    let schemas = ["policy", "rollout", "stats", "evaluation", "control", "task", "poses", "page", "pool"]
        .map(|name| format!("schema/{name}.proto"));
    let files = protox::compile(schemas, ["schema"])?;
    prost_build::Config::new()
        .bytes(["."])
        .type_attribute(".treadmill.v1.PolicyVersion", "#[derive(serde::Serialize, serde::Deserialize)]")
        // No part of a checkpoint.
        .field_attribute(".treadmill.v1.PolicyVersion.epoch", "#[serde(skip)]")
        .compile_fds(files)?;
    println!("cargo:rerun-if-changed=onnx");
    prost_build::Config::new().bytes(["."]).compile_fds(protox::compile(["onnx.proto"], ["onnx"])?)?;
    println!("cargo:rerun-if-changed=tensorboard");
    let files = protox::compile(["event.proto", "hparams.proto", "layout.proto"], ["tensorboard"])?;
    // Ordered maps, so that equal configurations give equal bytes.
    prost_build::Config::new().bytes(["."]).btree_map(["."]).compile_fds(files)?;
    Ok(())
}
