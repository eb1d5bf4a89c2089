//! Compiles the schemas with `protox`, so that no `protoc` has to be installed.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=schema");
    let schemas = ["policy", "rollout", "stats", "evaluation", "control", "task", "poses"]
        .map(|name| format!("schema/{name}.proto"));
    let files = protox::compile(schemas, ["schema"])?;
    prost_build::Config::new()
        .bytes(["."])
        // It is part of a checkpoint, too.
        .type_attribute("treadmill.v1.ActorState", "#[derive(serde::Serialize, serde::Deserialize)]")
        .compile_fds(files)?;
    println!("cargo:rerun-if-changed=onnx");
    prost_build::Config::new().bytes(["."]).compile_fds(protox::compile(["onnx.proto"], ["onnx"])?)?;
    Ok(())
}
