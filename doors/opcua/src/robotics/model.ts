// SPDX-License-Identifier: Apache-2.0
// The types of OPC 40010-1 (Robotics), with DI and IA, which it requires. They are loaded for the first robot, so that
// plants without one do not wait for them.

import type { AddressSpace, BaseNode, Namespace, NodeId, UAObject } from "node-opcua";

import { load_nodesets } from "../space/nodesets";

const FILES = ["Opc.Ua.Di.NodeSet2", "Opc.Ua.IA.NodeSet2", "Opc.Ua.Robotics.NodeSet2"];
const DI = "http://opcfoundation.org/UA/DI/";
const ROBOTICS = "http://opcfoundation.org/UA/Robotics/";

export interface Place {
  id: string;  // of the node, without its namespace
  name: string;
  parent: BaseNode;
  optionals?: string[];
}

export class Model {
  readonly device_set: UAObject;

  private constructor(private readonly space: AddressSpace, private readonly namespace: Namespace) {
    this.device_set = space.rootFolder.objects.getFolderElementByName("DeviceSet", space.getNamespaceIndex(DI)) as UAObject;
  }

  static async load(space: AddressSpace, namespace: Namespace): Promise<Model> {
    await load_nodesets(space, FILES);
    return new Model(space, namespace);
  }

  // An object with what its type demands.
  add(type: string, { id, name, parent, optionals }: Place): UAObject {
    const definition = this.space.findObjectType(type, this.index(type === "SoftwareType" ? DI : ROBOTICS));
    return definition!.instantiate({
      namespace: this.namespace, browseName: { name, namespaceIndex: this.namespace.index }, nodeId: `s=${id}`, componentOf: parent, optionals,
    }) as UAObject;
  }

  link(from: UAObject, type: string, to: UAObject): void {
    from.addReference({ referenceType: this.reference(type), nodeId: to.nodeId });
  }

  unlink(from: UAObject, type: string, to: UAObject): void {
    from.removeReference({ referenceType: this.reference(type), nodeId: to.nodeId });
  }

  private reference(type: string): NodeId {
    return this.space.findReferenceType(type, this.index(ROBOTICS))!.nodeId;
  }

  private index(uri: string): number {
    return this.space.getNamespaceIndex(uri);
  }
}
