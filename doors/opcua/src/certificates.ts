// SPDX-License-Identifier: Apache-2.0
// A folder with certificates: our own one, those of others that are trusted, and those that were rejected.

import { mkdir } from "node:fs/promises";

import { OPCUACertificateManager } from "node-opcua";

export async function make_certificate_manager(folder: string, accepts_unknown: boolean): Promise<OPCUACertificateManager> {
  await mkdir(folder, { recursive: true, mode: 0o700 });
  const manager = new OPCUACertificateManager({ rootFolder: folder, automaticallyAcceptUnknownCertificate: accepts_unknown });
  await manager.initialize();
  return manager;
}
